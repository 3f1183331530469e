#include "planning/visibility/shown_surface.h"

#include "engine/geometry/ray_caster.h"
#include "planning/visibility/view_estimator.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dollytrack::planning::shown_surface_test {
namespace {

/// Two full turns in the middle of the room: the second one shows nothing new.
Trajectory twiceAround(int frames_a_turn) {
    Trajectory trajectory;
    for (int i = 0; i < 2 * frames_a_turn; ++i) {
        const double angle = 2.0 * EIGEN_PI * (i % frames_a_turn) / frames_a_turn;
        TrajectoryFrame frame;
        const Eigen::Vector3d middle(2.0, 1.5, 1.3);
        frame.pose = lookAt(middle, middle + Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

struct Fixture {
    Scene scene = test::furnishedRoom();
    RayCaster rays{scene};
    ViewEstimator views{scene, rays, CameraParams{}};
};

}  // namespace

TEST(ShownSurface, TheSecondTurnRepeatsTheFirst) {
    const Fixture f;
    const auto shown = measureShownSurface(f.views, twiceAround(6), JobContext{});
    ASSERT_TRUE(shown);
    EXPECT_DOUBLE_EQ(shown->repeatRate(), 0.5);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(shown->repeats(i), i >= 6) << i;
    EXPECT_GT(shown->object_pixels, 0.0);
}

TEST(ShownSurface, ATrajectoryWithoutFramesShowsNothing) {
    const Fixture f;
    const auto shown = measureShownSurface(f.views, {}, JobContext{});
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->repeatRate(), 0.0);
    EXPECT_EQ(shown->object_pixels, 0.0);
}

}  // namespace dollytrack::planning::shown_surface_test
