#include "planning/motions/key_motion.h"

#include "engine/jobs/parallel.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/key_curve.h"
#include "planning/plan_params.h"
#include "tests/planning/support/plan_support.h"
#include "tests/planning/support/slow_checker.h"
#include "tests/support/scene_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace dollytrack::planning::key_motion_test {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.1;
constexpr double kInterval_s = 0.1;

MappedScene mapped(Scene scene) {
    auto made = mapScene(std::make_shared<const Scene>(std::move(scene)), {}, {}, {});
    EXPECT_TRUE(made.has_value());
    return std::move(*made);
}

/// A room of 6 x 4 m with a pillar in the middle, 1 m wide.
Scene roomWithPillar() {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 4, 2.6});
    builder.object("pillar").box({3.0, 2.0, 1.3}, {1.0, 1.0, 2.6});
    return builder.build();
}

MotionKey key(double time_s, const Vector3d& from, const Vector3d& to) {
    return {time_s, lookAt(from, to)};
}

/// Through the free front of the room, with room for every limit of the default preset.
std::vector<MotionKey> slowKeys() {
    return {key(0.0, {1.0, 0.6, 1.2}, {1.0, 4.0, 1.0}), key(6.0, {2.5, 0.8, 1.4}, {2.5, 4.0, 1.0}),
            key(11.0, {4.0, 0.7, 1.3}, {2.0, 4.0, 1.0}),
            key(17.0, {5.2, 1.5, 1.6}, {3.0, 4.0, 1.2})};
}

KeyMotion moved(const MappedScene& scene, const std::vector<MotionKey>& keys,
                const TimingParams& timing = {}) {
    auto made = moveThroughKeys(scene, timing, keys, {});
    EXPECT_TRUE(made.has_value()) << describe(made.error());
    return made.value_or(KeyMotion{});
}

/// Angular velocity from one orientation to another.
Vector3d turnRate(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, double seconds) {
    Eigen::Quaterniond turn = to * from.conjugate();
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    const Eigen::AngleAxisd angle_axis(turn);
    return angle_axis.angle() / seconds * angle_axis.axis();
}

/// Largest differences between frames, from rest before the first to rest after the last one.
struct Largest {
    double speed_mps = 0.0, acceleration_mps2 = 0.0, turn_rps = 0.0, turn_acceleration_rps2 = 0.0;
};
Largest largestOf(const Trajectory& trajectory) {
    Largest largest;
    Vector3d before = Vector3d::Zero();
    Vector3d turn_before = Vector3d::Zero();
    double seconds = trajectory.frame_interval_s;
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        Vector3d velocity = Vector3d::Zero();
        Vector3d turn = Vector3d::Zero();
        if (i + 1 < trajectory.frames.size()) {
            const TrajectoryFrame& a = trajectory.frames[i];
            const TrajectoryFrame& b = trajectory.frames[i + 1];
            seconds = b.time_s - a.time_s;
            velocity = (b.pose.position - a.pose.position) / seconds;
            turn = turnRate(a.pose.rotation, b.pose.rotation, seconds);
        }
        largest.speed_mps = std::max(largest.speed_mps, velocity.norm());
        largest.acceleration_mps2 =
            std::max(largest.acceleration_mps2, (velocity - before).norm() / seconds);
        largest.turn_rps = std::max(largest.turn_rps, turn.norm());
        largest.turn_acceleration_rps2 =
            std::max(largest.turn_acceleration_rps2, (turn - turn_before).norm() / seconds);
        before = velocity;
        turn_before = turn;
    }
    return largest;
}

/// Whether the camera overlaps a surface somewhere, tested every 5 mm with CGAL's distances.
bool collides(const Scene& scene, const Trajectory& trajectory) {
    const test_support::SlowChecker checker(scene);
    for (std::size_t i = 0; i + 1 < trajectory.frames.size(); ++i) {
        const Vector3d& from = trajectory.frames[i].pose.position;
        const Vector3d move = trajectory.frames[i + 1].pose.position - from;
        const double parts = std::max(1.0, std::ceil(move.norm() / 0.005));
        for (double k = 0.0; k < parts; k += 1.0) {
            if (checker.distance(from + k / parts * move) < kRadius - 1e-6) return true;
        }
    }
    return false;
}

void expectWithinLimits(const Trajectory& trajectory, const TimingParams& timing) {
    const MotionLimits limits = motionLimits(timing);
    const Largest largest = largestOf(trajectory);
    constexpr double kTolerance = 1.021;
    EXPECT_LE(largest.speed_mps, kTolerance * limits.speed_mps);
    EXPECT_LE(largest.acceleration_mps2, kTolerance * limits.acceleration_mps2);
    EXPECT_LE(largest.turn_rps, kTolerance * limits.turn_rps);
    EXPECT_LE(largest.turn_acceleration_rps2, kTolerance * limits.turn_acceleration_rps2);
}

}  // namespace

TEST(KeyMotion, PassesEveryKeyExactlyAtItsTime) {
    const MappedScene scene = mapped(roomWithPillar());
    const std::vector<MotionKey> keys = slowKeys();
    const KeyMotion made = moved(scene, keys);
    ASSERT_EQ(made.passed.size(), keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        EXPECT_EQ(made.passed[i].note, "") << i;
        EXPECT_NEAR(made.passed[i].time_s, keys[i].time_s, 1e-9);
        EXPECT_EQ(made.trajectory.frames[made.passed[i].frame].pose, keys[i].pose);
    }
    EXPECT_EQ(made.trajectory.frames.size(), 171U);
    expectWithinLimits(made.trajectory, {});
    EXPECT_FALSE(collides(*scene.scene, made.trajectory));
    for (const TrajectoryFrame& frame : made.trajectory.frames) {
        EXPECT_NEAR((frame.pose.rotation * Vector3d::UnitX()).z(), 0.0, 1e-12) << "it rolls";
    }
}

// The speed does not jump at keys: neighbouring moves differ by what the acceleration allows, and
// the camera does not stop at the keys in between.
TEST(KeyMotion, DoesNotStopAtTheKeysInBetween) {
    const KeyMotion made = moved(mapped(roomWithPillar()), slowKeys());
    const auto& frames = made.trajectory.frames;
    for (std::size_t i = 1; i + 1 < made.passed.size(); ++i) {
        const int at = made.passed[i].frame;
        const double move = (frames[at + 1].pose.position - frames[at].pose.position).norm();
        EXPECT_GT(move / kInterval_s, 0.1) << i;
    }
    EXPECT_LT((frames[1].pose.position - frames[0].pose.position).norm(), 0.01);
}

TEST(KeyMotion, RetimingAKeyKeepsThePath) {
    std::vector<MotionKey> keys = slowKeys();
    const KeyCurve curve(keys);
    KeyCurve later(keys);
    later.setTimes({0.0, 8.0, 11.0, 17.0});
    // Every position of the one is near a position of the other.
    for (std::size_t segment = 0; segment < 3; ++segment) {
        for (double share = 0.05; share < 1.0; share += 0.05) {
            const double begin = keys[segment].time_s;
            const Vector3d position =
                curve.at(segment, begin + share * (keys[segment + 1].time_s - begin)).position;
            double nearest = 1.0;
            const double from = segment == 1 ? 8.0 : begin;
            const double to = segment == 0 ? 8.0 : keys[segment + 1].time_s;
            for (double t = from; t <= to; t += 0.002) {
                nearest = std::min(nearest, (later.at(segment, t).position - position).norm());
            }
            EXPECT_LT(nearest, 2e-3) << segment << " " << share;
        }
    }
}

TEST(KeyMotion, TakesTheTimeThatTheLimitsNeedAndSaysSo) {
    const MappedScene scene = mapped(roomWithPillar());
    std::vector<MotionKey> keys = slowKeys();
    keys[1].time_s = 1.0;
    for (const MotionPreset preset : {MotionPreset::Easy, MotionPreset::Medium}) {
        TimingParams timing;
        timing.motion_preset = preset;
        const KeyMotion made = moved(scene, keys, timing);
        expectWithinLimits(made.trajectory, timing);
        EXPECT_GT(made.passed[1].time_s, 3.0);
        EXPECT_NE(made.passed[1].note.find("Key 2 is reached at"), std::string::npos)
            << made.passed[1].note;
        EXPECT_EQ(made.trajectory.frames[made.passed[1].frame].pose, keys[1].pose);
        EXPECT_FALSE(collides(*scene.scene, made.trajectory));
    }
    // The third key leaves time to catch up.
    const KeyMotion made = moved(scene, keys);
    EXPECT_NEAR(made.passed[2].time_s, keys[2].time_s, 1e-9);
    EXPECT_EQ(made.passed[2].note, "");
    TimingParams free;
    free.motion_preset = MotionPreset::Custom;
    EXPECT_EQ(moved(scene, keys, free).passed[1].note, "");
}

TEST(KeyMotion, AvoidsAnObstacleBetweenKeys) {
    const MappedScene scene = mapped(roomWithPillar());
    const std::vector<MotionKey> keys = {key(0.0, {1.0, 2.0, 1.3}, {6.0, 2.0, 1.3}),
                                         key(30.0, {5.0, 2.0, 1.3}, {6.0, 2.0, 1.3})};
    const KeyMotion made = moved(scene, keys);
    EXPECT_FALSE(collides(*scene.scene, made.trajectory));
    expectWithinLimits(made.trajectory, {});
    EXPECT_EQ(made.trajectory.frames.front().pose, keys[0].pose);
    EXPECT_EQ(made.trajectory.frames.back().pose.position, keys[1].pose.position);
}

TEST(KeyMotion, SaysWhichKeyIsInAnObstacle) {
    const MappedScene scene = mapped(roomWithPillar());
    std::vector<MotionKey> keys = slowKeys();
    keys[2].pose = lookAt({3.0, 1.45, 1.3}, {3.0, 4.0, 1.0});  // 5 cm in front of the pillar
    const KeyMotion made = moved(scene, keys);
    EXPECT_FALSE(collides(*scene.scene, made.trajectory));
    EXPECT_NE(made.passed[2].note.find("Key 3 is in or too close to 'pillar'"), std::string::npos)
        << made.passed[2].note;
    EXPECT_EQ(made.passed[1].note, "");
    EXPECT_LT(
        (made.trajectory.frames[made.passed[2].frame].pose.position - keys[2].pose.position).norm(),
        0.08);
}

TEST(KeyMotion, AKeyOutsideIsShownAndNamed) {
    const MappedScene scene = mapped(roomWithPillar());
    const KeyMotion one = moved(scene, {key(0.0, {-5.0, -5.0, 8.0}, {3.0, 2.0, 1.0})});
    ASSERT_EQ(one.trajectory.frames.size(), 1U);
    EXPECT_EQ(one.passed[0].note.find("Key 1 is outside the rooms: the camera passes there; move "
                                      "the key, for example to 0."),
              0U)
        << one.passed[0].note << " The nearest place is in a corner of the room.";
    const KeyMotion inside = moved(scene, {slowKeys().front()});
    EXPECT_EQ(inside.passed[0].note, "");
    EXPECT_EQ(inside.trajectory.frames.size(), 1U);
}

TEST(KeyMotion, SaysBetweenWhichKeysThereIsNoWay) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {3, 3, 2.5});
    builder.room({3.1, 0, 0}, {6.1, 3, 2.5});
    const KeyMotion made = moved(
        mapped(builder.build()),
        {key(0.0, {1.0, 1.0, 1.2}, {3.0, 1.0, 1.2}), key(20.0, {5.0, 1.0, 1.2}, {6.0, 1.0, 1.2})});
    EXPECT_NE(made.passed[1].note.find("No collision-free path leads from key 1 to key 2"),
              std::string::npos)
        << made.passed[1].note;
}

// The third of five keys is behind a wall without a door: the camera stays in the first room.
TEST(KeyMotion, SaysWhichFreeKeyIsNotReached) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {3, 3, 2.5});
    builder.room({3.1, 0, 0}, {6.1, 3, 2.5});
    std::vector<MotionKey> keys;
    for (const auto& [time_s, x] : std::vector<std::pair<double, double>>{
             {0.0, 1.0}, {20.0, 2.4}, {24.0, 3.4}, {28.0, 2.4}, {60.0, 1.0}}) {
        keys.push_back(key(time_s, {x, 1.0, 1.2}, {x, 3.0, 1.2}));
    }
    const KeyMotion made = moved(mapped(builder.build()), keys);
    for (const std::size_t i : {0U, 1U, 4U}) EXPECT_EQ(made.passed[i].note, "") << i;
    const double beside_m =
        (made.trajectory.frames[made.passed[2].frame].pose.position - keys[2].pose.position).norm();
    EXPECT_GT(beside_m, 0.3) << "the wall with the camera's radius on both sides";
    EXPECT_EQ(made.passed[2].note,
              fmt::format("Key 3 is not reached: the camera passes at a distance of {:.3f} m; move "
                          "it.",
                          beside_m));
}

TEST(KeyMotion, RoundingToFramesIsNoDelay) {
    const MappedScene scene = mapped(roomWithPillar());
    const KeyMotion made = moved(scene, {key(0.0, {1.0, 0.6, 1.2}, {1.0, 4.0, 1.0}),
                                         key(1.04, {1.02, 0.6, 1.2}, {1.02, 4.0, 1.0}),
                                         key(3.06, {1.06, 0.6, 1.2}, {1.06, 4.0, 1.0})});
    EXPECT_NEAR(made.passed[1].time_s, 1.0, 1e-9);
    EXPECT_NEAR(made.passed[2].time_s, 3.1, 1e-9);
    for (const PassedKey& passed : made.passed) EXPECT_EQ(passed.note, "");
}

// Keys that one frame passes follow each other by a frame, because equal times are refused.
TEST(KeyMotion, ReachedTimesRise) {
    GivenMotion motion;
    motion.keys = slowKeys();
    motion.keys = withReachedTimes(
        motion.keys,
        std::vector<PassedKey>{{0, 0.0, ""}, {30, 3.0, ""}, {30, 3.0, ""}, {50, 5.0, ""}},
        kInterval_s);
    EXPECT_EQ(motion.keys[1].time_s, 3.0);
    EXPECT_EQ(motion.keys[2].time_s, 3.0 + kInterval_s);
    EXPECT_EQ(motion.keys[3].time_s, 5.0);
    EXPECT_EQ(motion.keys[2].pose, slowKeys()[2].pose);
    EXPECT_FALSE(findFault(motion));
}

// Around a pillar, all keys much too early: the times that are found are kept in a plan of them.
TEST(KeyMotion, ReachableTimesAreReached) {
    const MappedScene scene = mapped(roomWithPillar());
    std::vector<MotionKey> keys = {
        key(0.0, {1.0, 2.0, 1.3}, {3.0, 2.0, 1.3}), key(0.5, {5.0, 2.0, 1.3}, {3.0, 2.0, 1.3}),
        key(1.0, {3.0, 0.6, 1.3}, {3.0, 2.0, 1.3}), key(1.2, {3.0, 3.4, 1.3}, {3.0, 2.0, 1.3}),
        key(90.0, {1.0, 2.0, 1.3}, {3.0, 2.0, 1.3})};
    const auto fitted = withReachableTimes(scene, {}, keys, {});
    ASSERT_TRUE(fitted);
    const KeyMotion made = moved(scene, *fitted);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        EXPECT_EQ(made.passed[i].note, "") << i;
        EXPECT_EQ((*fitted)[i].pose, keys[i].pose);
        EXPECT_LE(made.passed[i].time_s, (*fitted)[i].time_s + kInterval_s) << i;
        // The way around the pillar took a little less time than estimated.
        EXPECT_GE(made.passed[i].time_s, (*fitted)[i].time_s - 0.5) << i;
        if (i > 0) {
            EXPECT_GT((*fitted)[i].time_s, (*fitted)[i - 1].time_s);
        }
    }
    EXPECT_EQ(fitted->back().time_s, 90.0) << "it was in time";
}

TEST(KeyMotion, KeysAlongATrajectoryFollowTheOthers) {
    const MappedScene scene = mapped(roomWithPillar());
    const std::vector<MotionKey> keys = slowKeys();
    const Trajectory along = moved(scene, keys).trajectory;
    const auto longer = withKeysAlong(keys, along, {}, {});
    ASSERT_TRUE(longer);
    ASSERT_GT(longer->size(), keys.size() + 15);
    for (std::size_t i = 0; i < keys.size(); ++i) EXPECT_EQ((*longer)[i], keys[i]);
    EXPECT_EQ((*longer)[keys.size()].pose, along.frames.front().pose);
    EXPECT_EQ(longer->back().pose, along.frames.back().pose);
    // From the last key back to the first at up to 0.5 m/s.
    EXPECT_GT((*longer)[keys.size()].time_s, keys.back().time_s + 4.3 / 0.5);
    for (std::size_t i = keys.size() + 1; i < longer->size(); ++i) {
        EXPECT_LE((*longer)[i].time_s - (*longer)[i - 1].time_s, 1.5);
        EXPECT_GE((*longer)[i].time_s - (*longer)[i - 1].time_s, 0.5 - 1e-9);
    }
    EXPECT_EQ(withKeysAlong({}, along, {}, {})->front().time_s, 0.0);
}

// Keys at one place, reversals, a turn through the vertical, roll.
TEST(KeyMotion, KeepsLimitsForAwkwardKeys) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {6, 4, 2.6});
    const MappedScene scene = mapped(builder.build());
    const Vector3d a(1.0, 1.0, 1.3);
    const Vector3d b(4.0, 1.2, 1.3);
    MotionKey rolled = key(30.0, b, {6.0, 3.0, 0.5});
    rolled.pose.rotation =
        rolled.pose.rotation * Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
    const std::vector<std::vector<MotionKey>> cases = {
        {key(0, a, b), key(1, a, {0, 4, 1}), key(2, a, {0, 0, 1})},
        {key(0, a, b), key(1, b, a), key(2, a, b), key(3, b, a)},
        {key(0, a, a + Vector3d(0.1, 0, -1)), key(1, b, b + Vector3d(-0.1, 0, -1)),
         key(2, a, a - Vector3d::UnitZ())},
        {key(0, a, b), key(3, {2.0, 3.0, 1.0}, b), rolled, key(31, {5.0, 3.0, 1.0}, a)},
        {key(0, a, b), key(0.01, a, b), key(0.02, b, a)}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        SCOPED_TRACE(i);
        const KeyMotion made = moved(scene, cases[i]);
        expectWithinLimits(made.trajectory, {});
        EXPECT_LT(made.trajectory.frames.back().time_s, 120.0);
        for (std::size_t k = 0; k < cases[i].size(); ++k) {
            EXPECT_EQ(made.trajectory.frames[made.passed[k].frame].pose, cases[i][k].pose) << k;
        }
    }
}

TEST(KeyMotion, RepeatsExactlyWithAnyNumberOfThreads) {
    const MappedScene scene = mapped(roomWithPillar());
    std::vector<MotionKey> keys = slowKeys();
    keys[1].time_s = 1.0;
    keys[2].pose.position = {3.0, 1.45, 1.3};
    const KeyMotion first = moved(scene, keys);
    setThreadCount(1);
    const KeyMotion second = moved(scene, keys);
    setThreadCount(0);
    ASSERT_EQ(first.trajectory.frames.size(), second.trajectory.frames.size());
    for (std::size_t i = 0; i < first.trajectory.frames.size(); ++i) {
        EXPECT_EQ(first.trajectory.frames[i].pose, second.trajectory.frames[i].pose);
        EXPECT_EQ(first.trajectory.frames[i].time_s, second.trajectory.frames[i].time_s);
    }
}

TEST(KeyMotion, TooManyFramesAreRefused) {
    const MappedScene scene = mapped(roomWithPillar());
    std::vector<MotionKey> keys = slowKeys();
    keys.back().time_s = 1e6;
    EXPECT_FALSE(moveThroughKeys(scene, {}, keys, {}));
    keys = slowKeys();
    keys.back().pose.position.x() = 9e5;  // takes too long at any speed that is allowed
    const auto far = keyTimes(keys, motionLimits({}), kInterval_s, {});
    ASSERT_FALSE(far);
    EXPECT_EQ(far.error().code, ErrorCode::BadInput);
    EXPECT_TRUE(keyTimes(slowKeys(), motionLimits({}), kInterval_s, {}, 171));
    EXPECT_FALSE(keyTimes(slowKeys(), motionLimits({}), kInterval_s, {}, 170));
}

// The way around the pillar takes longer than the straight line, on which the keys fit.
TEST(KeyMotion, TooManyFramesAfterARepairAreRefused) {
    const Vector3d after(5.0, 2.0, 1.3);
    const std::vector<MotionKey> keys = {key(0.0, {1.0, 2.0, 1.3}, {6.0, 2.0, 1.3}),
                                         key(1.0, after, {6.0, 2.0, 1.3}),
                                         key(19999.8, after, {6.0, 2.0, 1.3})};
    const auto made = moveThroughKeys(mapped(roomWithPillar()), {}, keys, {});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::BadInput);
    EXPECT_NE(made.error().message.find("more than 200000 frames"), std::string::npos);
}

TEST(KeyMotion, TimingIsCancelled) {
    const auto cancelled = std::make_shared<std::atomic<bool>>(true);
    const auto times =
        keyTimes(slowKeys(), motionLimits({}), kInterval_s, JobContext(cancelled, {}));
    ASSERT_FALSE(times);
    EXPECT_EQ(times.error().code, ErrorCode::Cancelled);
}

TEST(KeyMotion, APlanFollowsKeysAndNotesThem) {
    PlanEdits edits;
    GivenMotion motion;
    motion.keys = slowKeys();
    edits.motion = motion;
    const Scene scene = roomWithPillar();
    const auto plan = test_support::planOf(scene, edits);
    ASSERT_EQ(plan->passed_keys.size(), 4U);
    EXPECT_TRUE(plan->given_motion);
    EXPECT_EQ(plan->trajectory.frames.size(), 171U);
    EXPECT_EQ(plan->smooth_paths.front().collisions, 0);
    // The frame rate of the plan is that of its parameters.
    PlanParams params;
    params.timing.frame_rate = 20.0;
    EXPECT_EQ(test_support::planOf(scene, params, edits)->trajectory.frames.size(), 341U);
}

}  // namespace dollytrack::planning::key_motion_test
