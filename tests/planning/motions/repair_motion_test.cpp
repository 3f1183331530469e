#include "planning/motions/repair_motion.h"

#include "engine/document/given_motion.h"
#include "engine/jobs/parallel.h"
#include "engine/plan/motion_metrics.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/pipeline/follow_motion.h"
#include "planning/pipeline/pipeline.h"
#include "planning/timing/motion_limits.h"
#include "tests/planning/support/slow_checker.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace dollytrack::planning::repair_motion_test {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.1;

MappedScene mapped(Scene scene, const PlanEdits& edits = {}) {
    auto made = mapScene(std::make_shared<const Scene>(std::move(scene)), edits, {}, {});
    EXPECT_TRUE(made.has_value());
    return std::move(*made);
}

/// A cupboard from wall to ceiling: y below 1 for x from 2 to 4.
Scene roomWithCupboard() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 4, 2.6});
    builder.object("cupboard").box({3.0, 0.5, 1.3}, {2.0, 1.0, 2.6});
    return builder.build();
}

Scene twoClosedRooms() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {3, 3, 2.5});
    builder.room({3.1, 0, 0}, {6.1, 3, 2.5});
    return builder.build();
}

/// A straight line at constant speed, looking along x.
Trajectory line(const Vector3d& from, const Vector3d& to, double speed_mps,
                double interval_s = 0.1) {
    Trajectory trajectory;
    trajectory.frame_interval_s = interval_s;
    const double parts = std::round((to - from).norm() / (speed_mps * interval_s));
    for (double k = 0.0; k <= parts; k += 1.0) {
        TrajectoryFrame frame;
        frame.time_s = k * interval_s;
        const Vector3d position = from + k / parts * (to - from);
        frame.pose = lookAt(position, position + Vector3d::UnitX());
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

RepairedMotion repaired(const MappedScene& scene, const Trajectory& given,
                        const PlanParams& params = {}) {
    auto result = repairMotion(scene, params, given, {});
    EXPECT_TRUE(result.has_value()) << describe(result.error());
    return result.value_or(RepairedMotion{});
}

/// Positions every 5 mm along all moves where the sphere overlaps a surface, by CGAL's distances.
int overlaps(const test_support::SlowChecker& checker, const Trajectory& trajectory) {
    int count = 0;
    const auto& frames = trajectory.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Vector3d& from = frames[i].pose.position;
        const bool moves = i + 1 < frames.size() && frames[i].path == frames[i + 1].path;
        const Vector3d move =
            moves ? (frames[i + 1].pose.position - from).eval() : Vector3d::Zero();
        const double parts = std::max(1.0, std::ceil(move.norm() / 0.005));
        for (double k = 0.0; k < parts; k += 1.0) {
            count += checker.distance(from + k / parts * move) < kRadius - 1e-6 ? 1 : 0;
        }
    }
    return count;
}

bool isSame(const Trajectory& a, const Trajectory& b) {
    return std::equal(a.frames.begin(), a.frames.end(), b.frames.begin(), b.frames.end(),
                      [](const TrajectoryFrame& x, const TrajectoryFrame& y) {
                          return x.pose == y.pose && x.time_s == y.time_s && x.path == y.path;
                      });
}

/// The trajectory with sinusoids of about `amplitude_m` added to its positions.
Trajectory shaken(Trajectory trajectory, double amplitude_m, std::uint64_t seed) {
    Random random(seed, 5);
    Eigen::Matrix<double, 3, 4> waves;
    for (int i = 0; i < 12; ++i) waves(i % 3, i / 3) = random.uniform(0.5, 4.0);
    for (TrajectoryFrame& frame : trajectory.frames) {
        for (int k = 0; k < 3; ++k) {
            frame.pose.position[k] += amplitude_m * 0.5 *
                                      (std::sin(waves(k, 0) * frame.time_s + waves(k, 1)) +
                                       std::sin(0.3 * waves(k, 2) * frame.time_s + waves(k, 3)));
        }
    }
    return trajectory;
}

}  // namespace

// The editor repairs over the maps of the displayed plan.
TEST(RepairMotion, GivesTheSameOverThePipelinesMaps) {
    const auto scene = std::make_shared<const Scene>(roomWithCupboard());
    Pipeline pipeline(scene);
    ASSERT_TRUE(pipeline.run({}, {}));
    const MappedScene over =
        mappedSceneOf(scene, {}, {}, pipeline.rays(), pipeline.freeSpace(), pipeline.region());
    EXPECT_EQ(over.free_space, pipeline.freeSpace());
    const Trajectory given = line({0.5, 0.5, 1.5}, {5.5, 0.5, 1.5}, 0.5);
    const RepairedMotion expected = repaired(mapped(roomWithCupboard()), given);
    const RepairedMotion found = repaired(over, given);
    EXPECT_GT(found.change.frames_moved, 0);
    ASSERT_EQ(found.trajectory.frames.size(), expected.trajectory.frames.size());
    for (std::size_t i = 0; i < found.trajectory.frames.size(); ++i) {
        EXPECT_EQ(found.trajectory.frames[i].pose.position,
                  expected.trajectory.frames[i].pose.position);
    }
}

// The camera passes a cupboard 5 cm too near: it must keep 10 cm, and the proof's margin of 1 cm.
TEST(RepairMotion, ShiftsByWhatIsMissing) {
    const MappedScene scene = mapped(roomWithCupboard());
    const Trajectory given = line({0.5, 1.05, 1.2}, {5.5, 1.05, 1.2}, 0.4);
    const RepairedMotion result = repaired(scene, given);
    EXPECT_GT(result.change.frames_in_collision, 50);
    EXPECT_EQ(result.change.moves_over_limits, 0);
    EXPECT_EQ(result.change.paths_cut, 0);
    EXPECT_GE(result.change.largest_shift_m, 0.05);
    EXPECT_LE(result.change.largest_shift_m, 0.065);
    int beside = 0;
    for (const TrajectoryFrame& frame : result.trajectory.frames) {
        const Vector3d& position = frame.pose.position;
        EXPECT_LT(angleBetween(frame.pose.rotation, given.frames.front().pose.rotation), 1e-9);
        if (position.x() < 1.85 || position.x() > 4.15) {
            EXPECT_EQ(position.y(), 1.05);
        }
        if (position.x() < 2.0 || position.x() > 4.0) continue;
        ++beside;
        EXPECT_GE(position.y(), 1.1);
        EXPECT_NEAR(position.z(), 1.2, 0.003);
    }
    EXPECT_GT(beside, 20);
    EXPECT_EQ(overlaps(test_support::SlowChecker(*scene.scene), result.trajectory), 0);
    EXPECT_GT(overlaps(test_support::SlowChecker(*scene.scene), given), 0);
}

TEST(RepairMotion, KeepsFreeMotionBitForBit) {
    const MappedScene scene = mapped(roomWithCupboard());
    for (const double interval_s : {0.1, 2.5}) {
        const Trajectory given = line({0.5, 2.0, 1.2}, {5.5, 2.0, 1.2}, 0.4, interval_s);
        const RepairedMotion result = repaired(scene, given);
        EXPECT_TRUE(isSame(result.trajectory, given));
        EXPECT_EQ(result.trajectory.frame_interval_s, interval_s);
        EXPECT_EQ(result.change.frames_moved, 0);
        EXPECT_EQ(result.change.time_added_s, 0.0);
    }
}

// Exactly as near to the cupboard as the camera is large: no proof with margins, but free.
TEST(RepairMotion, KeepsMotionThatTouches) {
    const MappedScene scene = mapped(roomWithCupboard());
    const Trajectory given = line({0.5, 1.1003, 1.2}, {5.5, 1.1003, 1.2}, 0.4);
    EXPECT_TRUE(isSame(repaired(scene, given).trajectory, given));
    const auto followed = followMotion(givenMotion("touching", given), scene, {}, {});
    ASSERT_TRUE(followed);
    EXPECT_EQ(followed->made.smooth_paths.front().collisions, 0);
}

TEST(RepairMotion, GoesThroughTheDoor) {
    const MappedScene scene = mapped(test::twoRoomsWithDoor(0.9));
    const Trajectory given = line({0.6, 2.6, 1.2}, {5.5, 2.6, 1.2}, 0.4);
    ASSERT_GT(repairMotion(scene, {}, given, {})->change.moves_in_collision, 0);
    const RepairedMotion result = repaired(scene, given);
    EXPECT_EQ(result.change.paths_cut, 0);
    EXPECT_EQ(result.trajectory.frames.front().pose, given.frames.front().pose);
    EXPECT_EQ(result.trajectory.frames.back().pose, given.frames.back().pose);
    EXPECT_EQ(result.trajectory.frames.back().path, result.trajectory.frames.front().path);
    EXPECT_GT(result.change.time_added_s, 1.0);
    EXPECT_EQ(overlaps(test_support::SlowChecker(*scene.scene), result.trajectory), 0);
}

TEST(RepairMotion, CutsAtAClosedWall) {
    const MappedScene scene = mapped(twoClosedRooms());
    const Trajectory given = line({1.0, 1.5, 1.2}, {5.0, 1.5, 1.2}, 0.4);
    const RepairedMotion result = repaired(scene, given);
    EXPECT_EQ(result.change.paths_cut, 1);
    EXPECT_EQ(result.trajectory.frames.back().path, 1);
    for (const TrajectoryFrame& frame : result.trajectory.frames) {
        EXPECT_EQ(frame.path == 0, frame.pose.position.x() < 3.05);
    }
    EXPECT_LE(result.change.largest_shift_m, 0.2);
    EXPECT_EQ(overlaps(test_support::SlowChecker(*scene.scene), result.trajectory), 0);
}

TEST(RepairMotion, PartsWithoutTimesFollowEachOther) {
    const MappedScene scene = mapped(twoClosedRooms());
    Trajectory given = line({1.0, 1.5, 1.2}, {5.0, 1.5, 1.2}, 0.4);
    for (TrajectoryFrame& frame : given.frames) frame.time_s = 0.0;
    const RepairedMotion result = repaired(scene, given);
    ASSERT_EQ(result.change.paths_cut, 1);
    EXPECT_FALSE(findFault(givenMotion("parts", result.trajectory)).has_value());
}

// It begins inside the cupboard, nearer to its far side than to the rest of the motion.
TEST(RepairMotion, MovesItsStartOutOfAnObstacle) {
    const MappedScene scene = mapped(roomWithCupboard());
    const Trajectory given = line({2.6, 0.8, 1.2}, {5.5, 0.8, 1.2}, 0.4);
    const RepairedMotion result = repaired(scene, given);
    EXPECT_EQ(result.trajectory.frames.back().pose, given.frames.back().pose);
    EXPECT_LE(result.change.largest_shift_m, 0.5);
    EXPECT_EQ(overlaps(test_support::SlowChecker(*scene.scene), result.trajectory), 0);
}

// Four times as fast as allowed.
TEST(RepairMotion, TakesTheTimeThatTheLimitsAsk) {
    const MappedScene scene = mapped(roomWithCupboard());
    const PlanParams params;
    const MotionLimits limits = motionLimits(params.timing);
    for (const double interval_s : {0.1, 0.5}) {
        const Trajectory given =
            line({0.5, 2.0, 1.2}, {5.5, 2.0, 1.2}, 4.0 * limits.speed_mps, interval_s);
        const RepairedMotion result = repaired(scene, given, params);
        const MotionMetrics motion = measureMotion(result.trajectory);
        EXPECT_EQ(result.change.moves_over_limits, static_cast<int>(given.frames.size()) - 1);
        EXPECT_EQ(result.change.frames_moved, 0);
        EXPECT_LE(motion.speed_mps.max, 1.02 * limits.speed_mps);
        EXPECT_LE(motion.acceleration_mps2.max, 1.02 * limits.acceleration_mps2);
        const double least = 5.0 / limits.speed_mps;
        EXPECT_GE(result.trajectory.frames.back().time_s, least);
        EXPECT_LE(result.trajectory.frames.back().time_s, 1.2 * least);
        EXPECT_NEAR(result.change.time_added_s, 0.75 * result.trajectory.frames.back().time_s, 1.0);
    }
}

TEST(RepairMotion, StaysOutOfNoGoBoxes) {
    NoGoBox box;
    box.box.center = {3.0, 2.0, 1.3};
    box.box.half_size = {0.5, 0.5, 1.3};
    PlanEdits edits;
    edits.no_go.push_back(box);
    const MappedScene scene = mapped(roomWithCupboard(), edits);
    const Trajectory given = line({0.5, 2.2, 1.2}, {5.5, 2.2, 1.2}, 0.4);
    const RepairedMotion result = repaired(scene, given);
    EXPECT_GT(result.change.frames_moved, 0);
    for (const TrajectoryFrame& frame : result.trajectory.frames) {
        EXPECT_GE(box.box.distance(frame.pose.position), kRadius);
    }
}

// Random shaken lines through a furnished room, by brute force.
TEST(RepairMotion, NeverCollides) {
    const MappedScene scene = mapped(test::furnishedRoom());
    const test_support::SlowChecker checker(*scene.scene);
    int broken = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Random random(seed, 9);
        const Vector3d from = randomPlace(scene, 0, random);
        const Vector3d to = randomPlace(scene, 0, random);
        if ((to - from).norm() < 0.5) continue;
        const Trajectory given = shaken(line(from, to, 0.3), 0.5, seed);
        broken += overlaps(checker, given) > 0 ? 1 : 0;
        const RepairedMotion result = repaired(scene, given);
        EXPECT_EQ(overlaps(checker, result.trajectory), 0) << "seed " << seed;
        const RepairedMotion again = repaired(scene, result.trajectory);
        EXPECT_TRUE(isSame(again.trajectory, result.trajectory)) << "seed " << seed;
    }
    EXPECT_GE(broken, 4);
}

TEST(RepairMotion, DoesNotDependOnTheThreads) {
    const MappedScene scene = mapped(test::furnishedRoom());
    const Trajectory given = shaken(line({0.5, 0.5, 1.0}, {3.5, 2.5, 1.0}, 0.3), 0.4, 3);
    setThreadCount(1);
    const RepairedMotion one = repaired(scene, given);
    setThreadCount(4);
    const RepairedMotion four = repaired(scene, given);
    setThreadCount(0);
    EXPECT_GT(one.change.frames_moved, 0);
    EXPECT_TRUE(isSame(one.trajectory, four.trajectory));
}

TEST(RepairMotion, SaysWhatIsWrong) {
    const MappedScene scene = mapped(roomWithCupboard());
    const auto codeOf = [&](const Trajectory& given, const JobContext& job = {}) {
        const auto result = repairMotion(scene, {}, given, job);
        return result ? ErrorCode::Failed : result.error().code;
    };
    EXPECT_EQ(codeOf({}), ErrorCode::BadInput);
    EXPECT_EQ(codeOf(line({100, 100, 1}, {101, 100, 1}, 0.4)), ErrorCode::BadInput);
    Trajectory broken = line({0.5, 2.0, 1.2}, {5.5, 2.0, 1.2}, 0.4);
    broken.frames[3].pose.position.y() = std::nan("");
    EXPECT_EQ(codeOf(broken), ErrorCode::BadInput);
    const auto cancelled = std::make_shared<const std::atomic<bool>>(true);
    EXPECT_EQ(codeOf(line({0.5, 1.05, 1.2}, {5.5, 1.05, 1.2}, 0.4), JobContext(cancelled, {})),
              ErrorCode::Cancelled);
}

}  // namespace dollytrack::planning::repair_motion_test
