#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/baselines/delaunay.h"
#include "planning/baselines/planner.h"
#include "planning/free_space/free_space.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

namespace dollytrack::planning::baselines_test {
namespace {

PlanParams smallBudget() {
    PlanParams params;
    params.timing.max_frames = 40;
    return params;
}

MappedScene mapped(Scene scene) {
    auto made = mapScene(std::make_shared<const Scene>(std::move(scene)), {}, smallBudget(), {});
    EXPECT_TRUE(made.has_value());
    return std::move(*made);
}

void expectSame(const PlannedMotion& a, const PlannedMotion& b) {
    ASSERT_EQ(a.trajectory.frames.size(), b.trajectory.frames.size());
    for (std::size_t i = 0; i < a.trajectory.frames.size(); ++i) {
        EXPECT_EQ(a.trajectory.frames[i].pose, b.trajectory.frames[i].pose) << i;
        EXPECT_EQ(a.trajectory.frames[i].time_s, b.trajectory.frames[i].time_s) << i;
    }
    EXPECT_EQ(a.between, b.between);
}

class EveryPlanner : public testing::TestWithParam<Planner> {};

}  // namespace

TEST_P(EveryPlanner, RepeatsExactlyWithAnyNumberOfThreads) {
    const MappedScene scene = mapped(test::furnishedRoom());
    setThreadCount(1);
    const auto one = GetParam().plan(scene, smallBudget(), 7, {});
    setThreadCount(4);
    const auto four = GetParam().plan(scene, smallBudget(), 7, {});
    setThreadCount(0);
    ASSERT_TRUE(one && four);
    expectSame(*one, *four);
}

// At least the camera's centre is in a room; the number of frames, the times and the orientations
// (unit quaternions, level unless shaken) are right.
TEST_P(EveryPlanner, KeepsToTheRoomAndTheBudget) {
    const MappedScene scene = mapped(test::twoRoomsWithDoor(0.9));
    const auto motion = GetParam().plan(scene, smallBudget(), 3, {});
    ASSERT_TRUE(motion);
    const auto& frames = motion->trajectory.frames;
    ASSERT_FALSE(frames.empty());
    EXPECT_LE(frames.size(), 40U);
    EXPECT_LE(motion->between.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(scene.free_space->stateAt(frames[i].pose.position), CellState::Free) << i;
        EXPECT_NEAR(frames[i].pose.rotation.norm(), 1.0, 1e-9);
        if (i > 0) {
            EXPECT_GT(frames[i].time_s, frames[i - 1].time_s);
        }
    }
}

TEST_P(EveryPlanner, StopsWhenCancelled) {
    const MappedScene scene = mapped(test::furnishedRoom());
    const JobContext cancelled(std::make_shared<std::atomic<bool>>(true), {});
    const auto motion = GetParam().plan(scene, smallBudget(), 1, cancelled);
    ASSERT_FALSE(motion);
    EXPECT_EQ(motion.error().code, ErrorCode::Cancelled);
}

INSTANTIATE_TEST_SUITE_P(Baselines, EveryPlanner, testing::ValuesIn(planners()),
                         [](const auto& test) {
                             std::string name(test.param.name);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Baselines, ASeedDecidesWhatIsRandom) {
    const MappedScene scene = mapped(test::furnishedRoom());
    for (const char* name : {"two-body", "density-walk", "random-keys", "uniform"}) {
        const Planner* planner = choosePlanners({name})->front();
        const auto a = planner->plan(scene, smallBudget(), 1, {});
        const auto b = planner->plan(scene, smallBudget(), 2, {});
        ASSERT_TRUE(a && b);
        EXPECT_FALSE(a->trajectory.frames[5].pose == b->trajectory.frames[5].pose) << name;
    }
}

TEST(Baselines, TheShakeMovesFramesByCentimetres) {
    const MappedScene scene = mapped(test::furnishedRoom());
    const auto easy = choosePlanners({"random-keys"})->front()->plan(scene, smallBudget(), 4, {});
    const auto hard =
        choosePlanners({"random-keys-hard"})->front()->plan(scene, smallBudget(), 4, {});
    ASSERT_TRUE(easy && hard);
    ASSERT_EQ(easy->trajectory.frames.size(), hard->trajectory.frames.size());
    double most = 0.0;
    for (std::size_t i = 0; i < easy->trajectory.frames.size(); ++i) {
        const double moved =
            (easy->trajectory.frames[i].pose.position - hard->trajectory.frames[i].pose.position)
                .norm();
        EXPECT_LE(moved, 0.06 * std::sqrt(3.0) + 1e-9);
        most = std::max(most, moved);
    }
    EXPECT_GT(most, 0.03);
}

// Two rooms of 3 x 3 m without a door between them: both get their share of the frames, and none is
// left over.
TEST(Baselines, FramesAreSharedByVolume) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {3, 3, 2.5});
    builder.room({3.2, 0, 0}, {6.2, 3, 2.5});
    builder.object("box a").box({1.5, 1.5, 0.2}, {0.4, 0.4, 0.4});
    builder.object("box b").box({4.7, 1.5, 0.2}, {0.4, 0.4, 0.4});
    const MappedScene scene = mapped(builder.build());
    ASSERT_EQ(scene.free_space->rooms().size(), 2U);
    const std::vector<int> shares = shareByRoom(scene, 41, 1);
    EXPECT_EQ(shares[0] + shares[1], 41);
    EXPECT_NEAR(shares[1], 20.5, 1.5);
    EXPECT_EQ(shareByRoom(scene, 30, 20), (std::vector<int>{30, 0}));
}

TEST(Baselines, AMisspeltNameIsToldTheRightOne) {
    const auto chosen = choosePlanners({"two-bdy"});
    ASSERT_FALSE(chosen);
    EXPECT_EQ(chosen.error().code, ErrorCode::Usage);
    EXPECT_NE(chosen.error().message.find("two-body"), std::string::npos);
    EXPECT_EQ(choosePlanners({"all"})->size(), planners().size());
}

// Checked against the definition: no point lies inside any circumcircle, and the triangles tile the
// convex hull.
TEST(Delaunay, CirclesAreEmptyAndTheHullIsTiled) {
    Random random(5);
    std::vector<Eigen::Vector2d> points = {{0, 0}, {4, 0}, {4, 3}, {0, 3}, {4, 0}};
    for (int i = 0; i < 60; ++i) {
        const double x = random.uniform(0.0, 4.0);
        points.emplace_back(x, random.uniform(0.0, 3.0));
    }
    double area = 0.0;
    for (const auto& t : delaunay(points)) {
        const Eigen::Vector2d a = points[t[0]];
        const Eigen::Vector2d b = points[t[1]] - a;
        const Eigen::Vector2d c = points[t[2]] - a;
        const double twice = b.x() * c.y() - b.y() * c.x();
        ASSERT_GT(twice, 0.0);
        area += 0.5 * twice;
        const Eigen::Vector2d center(
            (c.y() * b.squaredNorm() - b.y() * c.squaredNorm()) / (2.0 * twice),
            (b.x() * c.squaredNorm() - c.x() * b.squaredNorm()) / (2.0 * twice));
        for (const Eigen::Vector2d& p : points) {
            EXPECT_GE((p - a - center).norm(), center.norm() - 1e-9);
        }
    }
    EXPECT_NEAR(area, 12.0, 1e-6);
}

}  // namespace dollytrack::planning::baselines_test
