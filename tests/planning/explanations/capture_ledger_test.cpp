#include "planning/explanations/capture_ledger.h"

#include "engine/camera/intrinsics.h"
#include "engine/geometry/ray_caster.h"
#include "engine/plan/plan_json.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dollytrack::planning::capture_ledger_test {
namespace {

using test_support::planOf;

int idOf(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.objects, name, &Object::name);
    return found == scene.objects.end() ? 0 : found->id;
}

const LedgerRow& rowOf(const Scene& scene, const Plan& plan, const std::string& name) {
    const auto found = std::ranges::find(plan.ledger, idOf(scene, name), &LedgerRow::object_id);
    EXPECT_NE(found, plan.ledger.end()) << name;
    return *found;
}

/// Pixels of a 640 x 480 image in which the object is the first surface; one ray is cast per pixel.
int pixelsOf(const RayCaster& rays, const Pose& pose, int object_id) {
    const Intrinsics lens = makeIntrinsics({});
    int count = 0;
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            const Eigen::Vector3d direction = pose.rotation * lens.unproject(x + 0.5, y + 0.5);
            count += rays.cast(pose.position, direction).object_id == object_id;
        }
    }
    return count;
}

/// One object with one position point; each test fills in the rest of the plan.
struct MadeByHand {
    MadeByHand() {
        test::SceneBuilder builder;
        builder.object("vase").box({2, 1, 0.5}, {0.2, 0.2, 0.2});
        scene = builder.build();
        plan.observation_points.resize(1);
        plan.observation_points[0].objects = {1};
        plan.searches.resize(1);
        plan.position_points.resize(1);
        plan.position_points[0].captured = {1};
        plan.position_points[0].pose.position = {1, 1, 1};
        plan.captures.resize(1);
        plan.captures[0].object_id = 1;
        plan.captures[0].best.frame = plan.captures[0].best_well.frame = -1;
    }
    void onPath(const Eigen::Vector3d& passes) {
        plan.key_frames = {0};
        plan.smooth_paths.resize(1);
        plan.smooth_paths[0].keys = {{0.0, 0, passes}};
    }
    [[nodiscard]] LedgerRow row() const { return captureLedger(scene, plan).at(0); }
    /// The loss when the search tried exactly these positions and none became a view.
    Loss after(const std::vector<Verdict>& verdicts) {
        plan.position_points.clear();
        plan.searches[0].candidates.clear();
        for (const Verdict verdict : verdicts) {
            Candidate candidate;
            candidate.verdict = verdict;
            plan.searches[0].candidates.push_back(candidate);
        }
        return *row().loss;
    }

    Scene scene;
    Plan plan;
};

}  // namespace

TEST(CaptureLedger, ARowSaysWhatTheDecidingFrameShows) {
    const Scene scene = test::furnishedRoom();
    const auto plan = planOf(scene);
    ASSERT_EQ(plan->ledger.size(), 5U);
    const RayCaster rays(scene);
    for (const LedgerRow& row : plan->ledger) {
        SCOPED_TRACE(scene.object(row.object_id).name);
        EXPECT_TRUE(row.well_captured);
        EXPECT_FALSE(row.loss);
        EXPECT_TRUE(row.reason.empty());
        ASSERT_GE(row.frame, 0);
        const auto& frame = plan->trajectory.frames.at(row.frame);
        EXPECT_DOUBLE_EQ(row.time_s, frame.time_s);
        EXPECT_EQ(row.key_frame, frame.position_point >= 0);
        const Eigen::Vector3d center = scene.object(row.object_id).box.center;
        EXPECT_NEAR(row.distance_m, (center - frame.pose.position).norm(), 1e-9);
        const double counted = pixelsOf(rays, frame.pose, row.object_id) / (640.0 * 480.0);
        EXPECT_NEAR(row.mask_share, counted, 0.05 * counted + 1e-4);
    }
}

TEST(CaptureLedger, PlacesAreLostInTheOrderOfTheMethod) {
    MadeByHand made;
    using enum Verdict;
    EXPECT_EQ(made.after({InObstacle, OutsideRoom, TooClose, NoGo, HeightBand}), Loss::NoFreePose);
    EXPECT_EQ(made.after({InObstacle, InObstacle, OccludedBy}), Loss::Occluded);
    EXPECT_EQ(made.after({OccludedBy, OccludedBy, TooSmall}), Loss::TooSmall);
    EXPECT_EQ(made.after({OccludedBy, OccludedBy, Cropped}), Loss::DoesNotFit);
    EXPECT_EQ(made.after({TooSmall, Cropped}), Loss::TooSmall);
    EXPECT_EQ(made.after({}), Loss::NoFreePose);
}

TEST(CaptureLedger, AViewThatWasFoundIsFollowedToWhereItIsLost) {
    MadeByHand made;
    EXPECT_EQ(made.row().loss, Loss::OverBudget);
    made.plan.key_frames = {0};
    EXPECT_EQ(made.row().loss, Loss::OtherComponent);
    made.plan.smooth_paths.resize(1);
    EXPECT_EQ(made.row().loss, Loss::DroppedByPath);
    made.onPath({1, 1, 1});
    EXPECT_EQ(made.row().loss, Loss::DroppedByScore);
    made.plan.trajectory.frames.resize(1);
    made.plan.trajectory.frames[0].position_point = 0;
    EXPECT_EQ(made.row().loss, Loss::LostInSmoothing);
    // The path passes it 0.3 m away.
    made.onPath({1, 1.3, 1});
    EXPECT_NE(made.row().reason.find("0.30 m"), std::string::npos) << made.row().reason;
}

TEST(CaptureLedger, WhatOneStageKeepsIsNotBlamedOnIt) {
    MadeByHand made;
    // One view was dropped for the budget, another got as far as the path: the latter decides.
    made.plan.position_points.push_back(made.plan.position_points[0]);
    made.plan.key_frames = {1};
    made.plan.smooth_paths.resize(1);
    EXPECT_EQ(made.row().loss, Loss::DroppedByPath);
    // Captured, but not well: only views that capture well count.
    made.plan.captures[0].captured = true;
    EXPECT_EQ(made.row().loss, Loss::TooSmall);
    made.plan.position_points[0].well_captured = {1};
    EXPECT_EQ(made.row().loss, Loss::OverBudget);
}

TEST(CaptureLedger, AThingInACrateIsHiddenByIt) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("crate").box({2, 1.5, 0.4}, {0.8, 0.8, 0.8});
    builder.object("coin").box({2, 1.5, 0.4}, {0.1, 0.1, 0.1});
    const Scene scene = builder.build();
    const auto plan = planOf(scene);
    const LedgerRow& row = rowOf(scene, *plan, "coin");
    EXPECT_FALSE(row.captured);
    EXPECT_EQ(row.frame, -1);
    EXPECT_EQ(row.loss, Loss::Occluded);
    EXPECT_EQ(row.occluder, idOf(scene, "crate"));
    EXPECT_TRUE(rowOf(scene, *plan, "crate").well_captured);
    const auto json = metricsJson(scene, *plan);
    ASSERT_EQ(json["uncaptured"].size(), 1U);
    EXPECT_EQ(json["uncaptured"][0]["object"], "coin");
    EXPECT_EQ(json["ledger"].size(), 2U);
}

TEST(CaptureLedger, ANoGoBoxAroundAThingLeavesNoFreePose) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {8, 3, 2.6});
    builder.object("coin").box({1, 1.5, 1.0}, {0.05, 0.05, 0.05});
    const Scene scene = builder.build();
    PlanEdits edits;
    edits.no_go.resize(1);
    edits.no_go[0].name = "stage";
    edits.no_go[0].box.center = {1.5, 1.5, 1.3};
    edits.no_go[0].box.half_size = {2.5, 2, 2};  // 3 m of the room; the coin needs less than 2
    const auto plan = planOf(scene, {}, edits);
    EXPECT_EQ(rowOf(scene, *plan, "coin").loss, Loss::NoFreePose);
}

TEST(CaptureLedger, ATightBudgetIsToldFromBadPlaces) {
    const Scene scene = test::furnishedRoom();
    PlanParams params;
    params.timing.max_frames = 1;
    const auto plan = planOf(scene, params);
    int over = 0;
    for (const LedgerRow& row : plan->ledger) {
        if (row.captured) continue;
        EXPECT_EQ(row.loss, Loss::OverBudget) << row.reason;
        ++over;
    }
    EXPECT_GE(over, 1);
}

}  // namespace dollytrack::planning::capture_ledger_test
