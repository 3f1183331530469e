#include "engine/core/random.h"
#include "planning/path/tour.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace dollytrack::planning::trajectory_ends_test {
namespace {

using test_support::planOf;

PinnedPoint pinAt(const std::string& name, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return {name, lookAt(from, to), {}};
}

}  // namespace

TEST(Ends, TheTrajectoryBeginsAndEndsAtTheVeryPoses) {
    const Scene scene = test::furnishedRoom();
    PlanEdits edits;
    edits.pinned = {pinAt("in the corner", {0.4, 2.6, 1.5}, {3.0, 1.0, 0.5}),
                    pinAt("at the other", {3.6, 0.4, 1.9}, {1.0, 2.0, 0.7})};
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        for (const int max_frames : {0, 60, 4}) {
            for (const bool swapped : {false, true}) {
                PlanParams params;
                params.path.path_mode = mode;
                params.timing.max_frames = max_frames;
                params.shake.shake = ShakeKind::Sinusoidal;
                edits.start = edits.pinned[swapped ? 1 : 0].name;
                edits.end = edits.pinned[swapped ? 0 : 1].name;
                const auto plan = planOf(scene, params, edits);
                const auto& frames = plan->trajectory.frames;
                ASSERT_GE(frames.size(), 2U);
                EXPECT_EQ(frames.front().pose, edits.pinned[swapped ? 1 : 0].pose);
                EXPECT_EQ(frames.back().pose, edits.pinned[swapped ? 0 : 1].pose);
                if (max_frames > 0) {
                    EXPECT_LE(frames.size(), static_cast<std::size_t>(max_frames));
                }
            }
        }
    }
}

TEST(Ends, OneEndAloneIsKeptAndARefusedOneIsSaid) {
    const Scene scene = test::furnishedRoom();
    PlanEdits edits;
    edits.pinned = {pinAt("end", {3.6, 0.4, 1.9}, {1.0, 2.0, 0.7})};
    edits.end = "end";
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        PlanParams params;
        params.path.path_mode = mode;
        EXPECT_EQ(planOf(scene, params, edits)->trajectory.frames.back().pose,
                  edits.pinned[0].pose);
    }
    edits.pinned[0].pose.position = {9.0, 9.0, 1.0};
    const auto plan = planOf(scene, {}, edits);
    EXPECT_FALSE(plan->trajectory.frames.empty());
    EXPECT_EQ(plan->refused_pins.size(), 1U);
}

TEST(Ends, ALoopComesBackAndCapturesAsMuch) {
    const Scene scene = test::furnishedRoom();
    const auto open = planOf(scene);
    for (const PathMode mode : {PathMode::Tour, PathMode::LongestBranch}) {
        for (const int max_frames : {0, 50, 3}) {
            PlanParams params;
            params.path.path_mode = mode;
            params.timing.max_frames = max_frames;
            params.constraints.loop = true;
            const auto plan = planOf(scene, params);
            const auto& frames = plan->trajectory.frames;
            ASSERT_GE(frames.size(), 3U);
            EXPECT_EQ(frames.front().pose, frames.back().pose);
            EXPECT_EQ(plan->trajectory_metrics.frame_collision_rate, 0.0);
            if (max_frames > 0) {
                EXPECT_LE(frames.size(), static_cast<std::size_t>(max_frames));
            }
            if (max_frames == 0 && mode == PathMode::Tour) {
                EXPECT_EQ(plan->capture_metrics.captured, open->capture_metrics.captured);
            }
        }
    }
    PlanParams params;
    params.constraints.loop = true;
    PlanEdits edits;
    edits.pinned = {pinAt("home", {3.6, 0.4, 1.9}, {1.0, 2.0, 0.7})};
    edits.start = "home";
    const auto plan = planOf(scene, params, edits);
    EXPECT_EQ(plan->trajectory.frames.front().pose, edits.pinned[0].pose);
    EXPECT_EQ(plan->trajectory.frames.back().pose, edits.pinned[0].pose);
}

TEST(Ends, ToursBetweenGivenEndsAreShort) {
    Random random(3);
    double sum = 0.0;
    double best_sum = 0.0;
    for (int round = 0; round < 30; ++round) {
        const int count = 4 + static_cast<int>(random.below(4));
        std::vector<Eigen::Vector2d> places;
        for (int i = 0; i < count; ++i) places.emplace_back(random.uniform(), random.uniform());
        CostMatrix cost;
        for (const auto& a : places) {
            cost.emplace_back();
            for (const auto& b : places) cost.back().push_back((a - b).norm());
        }
        const TourEnds ends{static_cast<int>(random.below(3)) - 1, count - 1};
        const std::vector<int> tour = shortTour(cost, {}, ends);
        ASSERT_EQ(std::set<int>(tour.begin(), tour.end()).size(), places.size());
        ASSERT_EQ(tour.size(), places.size());
        if (ends.first >= 0) {
            EXPECT_EQ(tour.front(), ends.first);
        }
        EXPECT_EQ(tour.back(), ends.last);
        // The shortest of all orders.
        std::vector<int> order(places.size());
        std::iota(order.begin(), order.end(), 0);
        double best = std::numeric_limits<double>::infinity();
        do {
            const bool fits =
                order.back() == ends.last && (ends.first < 0 || order.front() == ends.first);
            if (fits) best = std::min(best, tourCost(cost, order));
        } while (std::next_permutation(order.begin(), order.end()));
        EXPECT_LE(tourCost(cost, tour), 1.25 * best);
        sum += tourCost(cost, tour);
        best_sum += best;
    }
    EXPECT_LE(sum, 1.03 * best_sum);
}

TEST(Ends, AStartInAnotherRoomComesFirst) {
    // Two rooms without a door between them: two paths.
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {3, 3, 2.5}).room({3.1, 0, 0}, {7.1, 3, 2.5});
    builder.object("a").box({0.5, 0.5, 0.3}, {0.5, 0.5, 0.6});
    builder.object("b").box({6.5, 0.5, 0.3}, {0.5, 0.5, 0.6});
    builder.object("c").box({6.5, 2.5, 0.3}, {0.3, 0.3, 0.6});
    const Scene scene = builder.build();
    PlanEdits edits;
    edits.pinned = {pinAt("small", {1.5, 2.0, 1.3}, {0.5, 0.5, 0.3}),
                    pinAt("large", {5.0, 2.0, 1.3}, {6.5, 0.5, 0.3})};
    for (const bool from_small : {false, true}) {
        edits.start = from_small ? "small" : "large";
        edits.end = from_small ? "large" : "small";
        const auto plan = planOf(scene, {}, edits);
        ASSERT_EQ(plan->paths.size(), 2U);
        const auto& frames = plan->trajectory.frames;
        EXPECT_EQ(frames.front().pose, edits.pinned[from_small ? 0 : 1].pose);
        EXPECT_EQ(frames.back().pose, edits.pinned[from_small ? 1 : 0].pose);
    }
}

}  // namespace dollytrack::planning::trajectory_ends_test
