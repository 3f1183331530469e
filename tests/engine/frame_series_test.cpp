#include "engine/plan/frame_series.h"

#include "engine/geometry/ray_caster.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace dollytrack::frame_series_test {
namespace {

/// Adds a path with these steps along y, the camera looking along x.
void addPath(Trajectory& trajectory, int path, const std::vector<double>& steps) {
    for (const double y : steps) {
        TrajectoryFrame frame;
        frame.time_s = trajectory.frame_interval_s * static_cast<double>(trajectory.frames.size());
        frame.path = path;
        frame.pose = lookAt({1.0, y, 1.0}, {2.0, y, 1.0});
        trajectory.frames.push_back(frame);
    }
}

ObjectView viewOf(int object, int frame, double fraction, double share = 0.2) {
    return {object, frame, fraction, 5000.0, share, 0.1};
}

TEST(FrameSeries, ClearanceIsTheExactDistanceToTheNearestSurface) {
    const Scene scene = test::furnishedRoom();
    const RayCaster rays(scene);
    Trajectory trajectory;
    addPath(trajectory, 0, {0.3, 0.8, 1.4, 2.0, 2.6});
    const FrameSeries series = measureFrames(trajectory, {}, {}, {}, rays);
    ASSERT_EQ(series.size(), 5U);
    for (std::size_t i = 0; i < series.size(); ++i) {
        // Compared with dense samples of all triangles.
        double nearest = std::numeric_limits<double>::infinity();
        for (const Triangle& triangle : scene.triangles) {
            const Eigen::Vector3d a = scene.positions[triangle[0]].cast<double>();
            const Eigen::Vector3d b = scene.positions[triangle[1]].cast<double>();
            const Eigen::Vector3d c = scene.positions[triangle[2]].cast<double>();
            constexpr int kSteps = 200;
            for (int u = 0; u <= kSteps; ++u) {
                for (int v = 0; u + v <= kSteps; ++v) {
                    const Eigen::Vector3d p = a + (b - a) * u / kSteps + (c - a) * v / kSteps;
                    nearest = std::min(nearest, (p - trajectory.frames[i].pose.position).norm());
                }
            }
        }
        EXPECT_LE(series.clearance_m[i], nearest + 1e-5);
        EXPECT_NEAR(series.clearance_m[i], nearest, 2e-3);
    }
}

TEST(FrameSeries, SpeedAndTurnBeginAnewWithEachPath) {
    const RayCaster rays(test::furnishedRoom());
    Trajectory trajectory;
    trajectory.frame_interval_s = 0.1;
    addPath(trajectory, 0, {0.5, 0.54, 0.54});
    addPath(trajectory, 1, {2.0, 2.05});
    trajectory.frames[2].pose.rotation =
        Eigen::AngleAxisd(3.0 * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()) *
        trajectory.frames[2].pose.rotation;
    const FrameSeries series = measureFrames(trajectory, {}, {}, {}, rays);
    const std::vector<double> speed = {0.0, 0.4, 0.0, 0.0, 0.5};
    const std::vector<double> turn = {0.0, 0.0, 30.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(series.speed_mps[i], speed[i], 1e-9) << i;
        EXPECT_NEAR(series.turn_dps[i], turn[i], 1e-6) << i;
    }
}

TEST(FrameSeries, CountsEachCapturedObjectOnceAndOnlyThoseThatCount) {
    const RayCaster rays(test::furnishedRoom());
    Trajectory trajectory;
    addPath(trajectory, 0, {0.5, 0.6, 0.7});
    // Object 1 is captured twice; 2 seems captured, but is not in the final result; 3 is captured
    // last, but too small in the image to be well captured.
    const std::vector<std::vector<ObjectView>> views = {
        {viewOf(1, 0, 0.9), viewOf(2, 0, 0.85)},
        {viewOf(1, 1, 0.95)},
        {viewOf(1, 2, 0.5), viewOf(3, 2, 1.0, 0.01)},
    };
    std::vector<ObjectCapture> captures(3);
    for (int i = 0; i < 3; ++i) captures[i].object_id = i + 1;
    captures[0].captured = captures[2].captured = true;
    const FrameSeries series = measureFrames(trajectory, views, captures, {}, rays);
    EXPECT_EQ(series.in_view, (std::vector<int>{2, 1, 2}));
    EXPECT_EQ(series.captured, (std::vector<int>{2, 1, 1}));
    EXPECT_EQ(series.well_captured, (std::vector<int>{2, 1, 0}));
    EXPECT_EQ(series.captured_so_far, (std::vector<int>{1, 1, 2}));
    EXPECT_EQ(series.newly_captured, (std::vector<std::vector<int>>{{1}, {}, {3}}));
}

TEST(FrameSeries, SpeedsAreMeasuredAcrossFramesThatWereLeftOut) {
    const RayCaster rays(test::furnishedRoom());
    Trajectory trajectory;
    trajectory.frame_interval_s = 0.1;
    addPath(trajectory, 0, {0.5, 0.54, 0.62, 0.66});
    for (std::size_t i = 0; i < 4; ++i) trajectory.frames[i].time_s = 0.1 * (i < 2 ? i : i + 1.0);
    const FrameSeries series = measureFrames(trajectory, {}, {}, {1, 2, 3, 4}, rays);
    const std::vector<double> speed = {0.0, 0.4, 0.4, 0.4};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(series.speed_mps[i], speed[i], 1e-9) << i;
    EXPECT_EQ(series.score, (std::vector<double>{1, 2, 3, 4}));
}

}  // namespace
}  // namespace dollytrack::frame_series_test
