#include "planning/analysis/plan_comparison.h"

#include "engine/plan/plan_json.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dollytrack::planning::plan_comparison_test {
namespace {

const ComparedMetric* find(const std::vector<ComparedMetric>& metrics, std::string_view name) {
    for (const ComparedMetric& one : metrics) {
        if (one.info.name == name) return &one;
    }
    return nullptr;
}

Trajectory ofFrames(int count, double interval_s) {
    Trajectory trajectory;
    trajectory.frame_interval_s = interval_s;
    for (int i = 0; i < count; ++i) trajectory.frames.emplace_back().time_s = 2.0 + interval_s * i;
    return trajectory;
}

}  // namespace

TEST(PlanComparison, TellsDifferencesAndWhichPlanIsBetter) {
    const nlohmann::json a = {
        {"capture_rate", 0.988},      {"repeat_rate", 0.1},
        {"path_length_m", 20.26},     {"frames", 300},
        {"min_clearance_m", nullptr}, {"repair", {{"after", {{"mean_score", 1.2}}}}}};
    const nlohmann::json b = {
        {"capture_rate", 0.9561}, {"repeat_rate", 0.1004},
        {"path_length_m", 18.0},  {"frames", 280},
        {"trackable_rate", 0.5},  {"repair", {{"after", {{"mean_score", 1.3}}}}}};
    const auto metrics = comparePlans({a, ofFrames(300, 0.1)}, {b, ofFrames(280, 0.1)});

    const ComparedMetric* captured = find(metrics, "capture_rate");
    ASSERT_NE(captured, nullptr);
    EXPECT_EQ(captured->differenceText(), "+3.2");
    EXPECT_EQ(captured->betterA(), 1);
    // Equal as shown.
    const ComparedMetric* repeats = find(metrics, "repeat_rate");
    EXPECT_FALSE(repeats->differs());
    EXPECT_EQ(repeats->differenceText(), "");
    EXPECT_EQ(repeats->betterA(), 0);
    // A shorter path is better.
    const ComparedMetric* path = find(metrics, "path_length_m");
    EXPECT_EQ(path->differenceText(), "+2.3");
    EXPECT_EQ(path->betterA(), -1);
    // More frames are neither better nor worse.
    const ComparedMetric* frames = find(metrics, "frames");
    EXPECT_EQ(frames->differenceText(), "+20");
    EXPECT_EQ(frames->betterA(), 0);
    EXPECT_DOUBLE_EQ(*find(metrics, "duration_s")->a, 30.0);
    EXPECT_DOUBLE_EQ(*find(metrics, "duration_s")->b, 28.0);
    EXPECT_EQ(find(metrics, "repair.after.mean_score")->differenceText(), "-0.10");
    // A metric of one plan only; one of none.
    const ComparedMetric* trackable = find(metrics, "trackable_rate");
    EXPECT_FALSE(trackable->a);
    EXPECT_TRUE(trackable->differs());
    EXPECT_EQ(trackable->differenceText(), "");
    EXPECT_EQ(trackable->betterA(), 0);
    EXPECT_EQ(find(metrics, "min_clearance_m"), nullptr);
}

TEST(PlanComparison, TheMustSeeRateNeedsRegions) {
    const nlohmann::json without = {{"must_see_rate", 1.0}};
    const nlohmann::json with = {{"must_see_rate", 0.5}, {"must_see", {{{"region", "altar"}}}}};
    EXPECT_EQ(find(comparePlans({without, {}}, {without, {}}), "must_see_rate"), nullptr);
    const auto one_sided = comparePlans({without, {}}, {with, {}});
    const ComparedMetric* seen = find(one_sided, "must_see_rate");
    ASSERT_NE(seen, nullptr);
    EXPECT_EQ(seen->a, std::nullopt);
    EXPECT_EQ(seen->b, 0.5);
}

TEST(PlanComparison, APlanDoesNotDifferFromItself) {
    const Scene scene = test::furnishedRoom();
    const auto plan = test_support::planOf(scene);
    const nlohmann::json metrics = metricsJson(scene, *plan);
    const auto compared = comparePlans({metrics, plan->trajectory}, {metrics, plan->trajectory});
    for (const char* name : {"capture_rate", "repair.after.mean_score", "min_clearance_m",
                             "speed_max_mps", "key_frames", "corner_collision_rate"}) {
        const ComparedMetric* one = find(compared, name);
        ASSERT_NE(one, nullptr) << name;
        EXPECT_TRUE(one->a) << name;
    }
    for (const ComparedMetric& one : compared) EXPECT_FALSE(one.differs()) << one.info.name;
}

}  // namespace dollytrack::planning::plan_comparison_test
