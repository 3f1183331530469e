#include "planning/repair/low_runs.h"

#include "engine/jobs/parallel.h"
#include "planning/linking/rrt_star.h"
#include "planning/pipeline/pipeline.h"
#include "tests/planning/support/plan_support.h"
#include "tests/planning/support/slow_checker.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dollytrack::planning::repair_test {
namespace {

using test_support::planOf;

/// A long hall with small objects far apart: on its path the camera passes long segments of bare
/// wall.
Scene longHall() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {14, 4, 2.6});
    const auto thing = [&](const std::string& name, double x, double y, double size) {
        builder.object(name).box({x, y, 0.5 * size}, {size, size, size});
    };
    thing("west 1", 0.6, 0.8, 0.4);
    thing("west 2", 0.6, 3.2, 0.5);
    thing("east 1", 13.4, 0.8, 0.5);
    thing("east 2", 13.4, 3.2, 0.4);
    for (const int i : {1, 2, 3}) {
        thing("south " + std::to_string(i), 3.5 * i, 0.3, 0.3);
        thing("north " + std::to_string(i), 3.5 * i + 0.6, 3.8, 0.2);
    }
    return builder.build();
}

PlanParams repaired(int rounds) {
    PlanParams params;
    params.repair.repair_rounds = rounds;
    params.repair.score_threshold = 0.9;
    params.gaze.view_mix = 0.0;  // context views change with the path, beside the repaired segment
    return params;
}

int countLow(std::vector<double> scores, double threshold) {
    return static_cast<int>(std::ranges::count_if(scores, [&](double s) { return s < threshold; }));
}

}  // namespace

TEST(LowRuns, EndAtKeyFramesAndWhereAPathEnds) {
    Trajectory trajectory;
    const std::vector<int> paths = {0, 0, 0, 0, 0, 0, 1, 1, 1};
    const std::vector<int> keys = {5, -1, -1, 7, -1, -1, 8, -1, 9};
    for (std::size_t i = 0; i < paths.size(); ++i) {
        TrajectoryFrame frame;
        frame.path = paths[i];
        frame.position_point = keys[i];
        trajectory.frames.push_back(frame);
    }
    const auto runs = lowRuns(trajectory, {0, 0, 0, 0, 0, 2, 0, 0, 0}, 1.0);
    ASSERT_EQ(runs.size(), 3U);
    const auto expect = [&](std::size_t i, SegmentId segment, std::size_t first, std::size_t last) {
        EXPECT_EQ(runs[i].segment, segment) << i;
        EXPECT_EQ(runs[i].first, first) << i;
        EXPECT_EQ(runs[i].last, last) << i;
    };
    expect(0, {0, 0}, 1, 2);
    expect(1, {0, 1}, 4, 4);
    expect(2, {1, 0}, 7, 7);
}

TEST(Repair, LeavesFewerLowFramesAndLosesNothing) {
    const Scene scene = longHall();
    const auto before = planOf(scene, repaired(0));
    const auto after = planOf(scene, repaired(4));
    ASSERT_GT(before->repair.after.low, 0);
    EXPECT_EQ(before->repair.rounds, 0);
    EXPECT_EQ(after->repair.before, before->repair.after);
    EXPECT_LT(after->repair.after.low, after->repair.before.low);
    EXPECT_GE(after->repair.after.mean, after->repair.before.mean);
    EXPECT_GT(after->repair.look_asides + after->repair.replanned, 0);
    // The reported count matches the frames' scores.
    EXPECT_EQ(after->repair.after.low, countLow(after->series.score, after->repair.threshold));
    ASSERT_EQ(before->captures.size(), after->captures.size());
    for (std::size_t i = 0; i < before->captures.size(); ++i) {
        EXPECT_GE(after->captures[i].captured, before->captures[i].captured) << i;
        EXPECT_GE(after->captures[i].well_captured, before->captures[i].well_captured) << i;
    }
}

// An alternative path rounds the corners at its two end key frames differently; turning the camera
// aside changes none.
TEST(Repair, KeepsKeyFramesToTheLastBitButAtTheEndsOfOtherWays) {
    const Scene scene = longHall();
    const auto keyPoses = [](const Plan& plan) {
        std::map<int, Pose> poses;
        for (const TrajectoryFrame& frame : plan.trajectory.frames) {
            if (frame.position_point >= 0) poses[frame.position_point] = frame.pose;
        }
        return poses;
    };
    const auto before = keyPoses(*planOf(scene, repaired(0)));
    for (const int rounds : {1, 4}) {
        const auto plan = planOf(scene, repaired(rounds));
        const auto after = keyPoses(*plan);
        ASSERT_EQ(before.size(), after.size());
        int changed = 0;
        for (const auto& [point, pose] : before) changed += !(after.at(point) == pose);
        EXPECT_LE(changed, 2 * plan->repair.replanned);
    }
}

// Both key frames see each other, and the straight path between them shows nothing.
TEST(OtherWay, LeadsAroundThoughTheStraightWayIsFree) {
    RrtStarProblem problem;
    problem.start = {0, 0, 0};
    problem.goal = {4, 0, 0};
    problem.max_iterations = 400;
    problem.improve_at_least = 0;
    problem.sample = [](Random& r) {
        return Eigen::Vector3d(r.uniform(0.0, 4.0), r.uniform(-2.0, 2.0), 0.0);
    };
    problem.is_free = [](const Eigen::Vector3d&) { return true; };
    problem.is_move_free = [](const Eigen::Vector3d&, const Eigen::Vector3d&) { return true; };
    EXPECT_TRUE(rrtStar(problem, Random(1)).corners.empty());
    problem.detour = true;
    std::set<double> sides;
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        const RrtStarResult way = rrtStar(problem, Random(seed));
        ASSERT_TRUE(way.found);
        ASSERT_FALSE(way.corners.empty());
        sides.insert(way.corners.front().y());
    }
    EXPECT_EQ(sides.size(), 4U) << "each seed another way";
}

TEST(Repair, KeepsTheSphereOutOfAllTriangles) {
    const auto scene = std::make_shared<const Scene>(longHall());
    const test_support::SlowChecker checker(*scene);
    Pipeline pipeline(scene);
    for (const int seed : {1, 2, 3}) {
        PlanParams params = repaired(6);
        params.seed = seed;
        // Half of all frames are low, so alternative paths are tried.
        params.repair.score_threshold = 1.0;
        const auto plan = pipeline.run(params, JobContext{});
        ASSERT_TRUE(plan.has_value());
        const auto found = checker.check(**plan, params.camera.camera_radius_m, false);
        EXPECT_GT(found.places, 500);
        EXPECT_EQ(found.touching, 0) << seed;
        EXPECT_EQ((*plan)->trajectory_metrics.frame_collision_rate, 0.0);
    }
}

TEST(Repair, LeavesOutLowFramesButNoneThatIsNeeded) {
    const Scene scene = longHall();
    const auto before = planOf(scene, repaired(0));
    PlanParams params = repaired(0);
    params.repair.drop_low_frames = true;
    const auto after = planOf(scene, params);
    EXPECT_GT(after->repair.dropped, 0);
    EXPECT_EQ(before->trajectory.frames.size(),
              after->trajectory.frames.size() + static_cast<std::size_t>(after->repair.dropped));
    EXPECT_EQ(before->capture_metrics.captured, after->capture_metrics.captured);
    EXPECT_EQ(before->capture_metrics.well_captured, after->capture_metrics.well_captured);
    // Each remaining frame keeps its pose and its time.
    auto at = before->trajectory.frames.begin();
    for (const TrajectoryFrame& frame : after->trajectory.frames) {
        at = std::find_if(at, before->trajectory.frames.end(),
                          [&](const TrajectoryFrame& f) { return f.time_s == frame.time_s; });
        ASSERT_NE(at, before->trajectory.frames.end());
        EXPECT_EQ(at->pose.position, frame.pose.position);
    }
}

TEST(Repair, KeepsToABudgetOfFrames) {
    PlanParams params = repaired(4);
    params.timing.max_frames = 40;
    const auto plan = planOf(longHall(), params);
    EXPECT_LE(plan->trajectory.frames.size(), 40U);
}

TEST(Repair, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = longHall();
    for (const int max_frames : {0, 200}) {  // with a budget, repeated frames count, too
        PlanParams params = repaired(3);
        params.timing.max_repeat_rate = 0.2;
        params.timing.max_frames = max_frames;
        std::vector<std::vector<double>> scores;
        for (const int threads : {1, 2, 5}) {
            setThreadCount(threads);
            scores.push_back(planOf(scene, params)->series.score);
        }
        setThreadCount(0);
        EXPECT_EQ(scores[0], scores[1]);
        EXPECT_EQ(scores[0], scores[2]);
    }
}

}  // namespace dollytrack::planning::repair_test
