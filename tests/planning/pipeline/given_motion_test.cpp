#include "planning/pipeline/pipeline.h"

#include "engine/geometry/ray_caster.h"
#include "engine/plan/plan_json.h"
#include "planning/pipeline/follow_motion.h"
#include "tests/planning/support/plan_support.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dollytrack::planning::given_motion_test {
namespace {

using test_support::planOf;

/// A straight line with a view to one side, at 10 frames per second.
GivenMotion line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int frames) {
    GivenMotion motion{"line", 0.1, {}};
    for (int i = 0; i < frames; ++i) {
        const Eigen::Vector3d position = from + (to - from) * i / (frames - 1);
        motion.frames.push_back({0.1 * i, lookAt(position, {2.0, 1.5, 0.4}), 0});
    }
    return motion;
}

PlanEdits with(const GivenMotion& motion) {
    PlanEdits edits;
    edits.motion = motion;
    return edits;
}

void expectFollowed(const Plan& plan, const GivenMotion& motion) {
    ASSERT_EQ(plan.trajectory.frames.size(), motion.frames.size());
    for (std::size_t i = 0; i < motion.frames.size(); ++i) {
        EXPECT_EQ(plan.trajectory.frames[i].pose, motion.frames[i].pose);
        EXPECT_EQ(plan.trajectory.frames[i].time_s, motion.frames[i].time_s);
    }
}

/// All of the plan that a project stores; no times.
std::string textOf(const Plan& plan, const Scene& scene) {
    return resultJson(scene, plan).dump();
}

}  // namespace

TEST(GivenMotion, APlannedTrajectoryGivenBackIsMeasuredAlike) {
    const Scene scene = test::furnishedRoom();
    const auto planned = planOf(scene);
    const GivenMotion motion = dollytrack::givenMotion("planned", planned->trajectory);
    const auto plan = planOf(scene, with(motion));
    expectFollowed(*plan, motion);
    EXPECT_TRUE(plan->given_motion);
    EXPECT_FALSE(planned->given_motion);
    EXPECT_EQ(plan->capture_metrics.captured, planned->capture_metrics.captured);
    EXPECT_EQ(plan->capture_metrics.well_captured, planned->capture_metrics.well_captured);
    EXPECT_EQ(plan->trajectory_metrics.repeat_rate, planned->trajectory_metrics.repeat_rate);
    EXPECT_EQ(plan->trajectory_metrics.object_pixels, planned->trajectory_metrics.object_pixels);
    EXPECT_EQ(plan->series.clearance_m, planned->series.clearance_m);
    EXPECT_EQ(plan->series.speed_mps, planned->series.speed_mps);
    // Chords are shorter than the curves between the frames.
    EXPECT_LE(plan->trajectory_metrics.path_length_m, planned->trajectory_metrics.path_length_m);
    EXPECT_GT(plan->trajectory_metrics.path_length_m,
              0.98 * planned->trajectory_metrics.path_length_m);
    EXPECT_EQ(plan->ledger.size(), planned->ledger.size());
    EXPECT_TRUE(plan->roadmap.edges.empty());
    EXPECT_TRUE(plan->key_frames.empty());
}

TEST(GivenMotion, CollisionsAreReportedAndNothingIsMoved) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {4, 3, 2.6});
    builder.object("pillar").box({2.0, 1.5, 1.0}, {0.3, 0.3, 2.0});
    const Scene scene = builder.build();
    // Through the pillar at 1 m height: x from 1 to 3 in steps of 0.1 m.
    GivenMotion motion = line({1, 1.5, 1.0}, {3, 1.5, 1.0}, 21);
    for (MotionFrame& frame : motion.frames) {
        frame.pose.rotation = lookAlong(Eigen::Vector3d::UnitY());
    }
    const auto plan = planOf(scene, with(motion));
    expectFollowed(*plan, motion);
    // Surfaces at x = 1.85 and 2.15, radius 0.1: frames at 1.8, 1.9, 2.1, 2.2 touch them.
    EXPECT_NEAR(plan->trajectory_metrics.frame_collision_rate * 21, 4, 1e-9);
    EXPECT_EQ(plan->smooth_paths.front().collisions,
              plan->trajectory_metrics.straight_lines_that_hit);
    EXPECT_GE(plan->trajectory_metrics.straight_lines_that_hit, 4);
    EXPECT_NEAR(plan->trajectory_metrics.minimum_clearance.clearance_m, 0.0, 1e-4);
    EXPECT_NEAR(plan->trajectory_metrics.path_length_m, 2.0, 1e-12);
    // The negative control: above the pillar nothing is hit.
    for (MotionFrame& frame : motion.frames) frame.pose.position.z() = 2.3;
    const auto above = planOf(scene, with(motion));
    EXPECT_EQ(above->trajectory_metrics.frame_collision_rate, 0.0);
    EXPECT_EQ(above->smooth_paths.front().collisions, 0);
}

TEST(GivenMotion, TheLedgerSaysWhatTheMotionMisses) {
    const Scene scene = test::furnishedRoom();
    GivenMotion motion = line({1.0, 2.5, 1.6}, {1.2, 2.5, 1.6}, 3);
    for (MotionFrame& frame : motion.frames) {
        frame.pose.rotation = lookAlong(Eigen::Vector3d::UnitZ());  // at the ceiling
    }
    const auto plan = planOf(scene, with(motion));
    EXPECT_EQ(plan->capture_metrics.captured, 0);
    ASSERT_FALSE(plan->ledger.empty());
    for (const LedgerRow& row : plan->ledger) {
        EXPECT_EQ(row.loss, Loss::NotInMotion) << row.reason;
    }
}

TEST(GivenMotion, APipelineGivesTheSamePlansInAnyOrder) {
    const auto scene = std::make_shared<const Scene>(test::furnishedRoom());
    const GivenMotion one = line({1.0, 2.4, 1.6}, {2.5, 2.4, 1.6}, 16);
    GivenMotion jumps = one;
    for (std::size_t i = 8; i < jumps.frames.size(); ++i) jumps.frames[i].path = 3;
    PlanParams other;
    other.camera.hfov_deg = 60.0;
    other.timing.duration_s = 20.0;
    other.constraints.rooms = RoomTours::Each;
    Pipeline kept(scene);
    const auto same = [&](const PlanParams& params, const PlanEdits& edits) {
        const auto plan = kept.run(params, edits, {});
        ASSERT_TRUE(plan) << describe(plan.error());
        EXPECT_EQ(textOf(**plan, *scene), textOf(*planOf(*scene, params, edits), *scene));
    };
    PlanEdits boxed = with(one);
    boxed.no_go.push_back({"box", {{2.0, 2.4, 1.6}, {0.2, 0.2, 0.2}, 0.0}});
    same({}, {});
    same({}, with(one));
    same({}, with(jumps));
    same(other, with(jumps));
    same({}, boxed);
    same({}, with(one));
    same({}, {});
}

TEST(GivenMotion, PathsFollowTheFrames) {
    GivenMotion motion = line({1.0, 2.4, 1.6}, {2.5, 2.4, 1.6}, 16);
    motion.frames[3].pose.position = motion.frames[2].pose.position;  // it rests
    for (std::size_t i = 8; i < 12; ++i) motion.frames[i].path = 2;
    const auto plan = planOf(test::furnishedRoom(), with(motion));
    ASSERT_EQ(plan->smooth_paths.size(), 3U);
    ASSERT_EQ(plan->paths.size(), 3U);
    for (const TrajectoryFrame& frame : plan->trajectory.frames) {
        const SmoothPath& path = plan->smooth_paths[frame.path];
        EXPECT_LT((path.at(frame.arc_m) - frame.pose.position).norm(), 1e-9);
    }
    EXPECT_NEAR(plan->smooth_paths[0].length_m, 0.7, 1e-12);
    EXPECT_EQ(plan->paths[0].vertices.size(), 7U);
}

// Far outside, in a wrong unit, with a single frame: measured, not refused.
TEST(GivenMotion, AnyMotionIsMeasured) {
    const Scene scene = test::furnishedRoom();
    for (const GivenMotion& motion :
         {line({1000, 2400, 1600}, {2500, 2400, 1600}, 16), line({1e6, 1e6, 1e6}, {-1e6, 0, 0}, 3),
          GivenMotion{"one", 0.1, {{0.0, lookAt({1, 2.4, 1.6}, {2, 1, 0.5}), 0}}}}) {
        const auto plan = planOf(scene, with(motion));
        expectFollowed(*plan, motion);
        for (const TrajectoryFrame& frame : plan->trajectory.frames) {
            EXPECT_EQ(frame.component, 0);
        }
    }
}

}  // namespace dollytrack::planning::given_motion_test
