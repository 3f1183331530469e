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

TEST(SurfaceSampler, TheSecondTurnRepeatsTheFirstAtAnyDetail) {
    const Fixture f;
    const Trajectory twice = twiceAround(6);
    for (const auto detail : {SurfaceSampler::Detail::Fine, SurfaceSampler::Detail::Coarse}) {
        SurfaceSampler sampler(f.views, detail);
        const auto shown = sampler.sample(twice, JobContext{});
        ASSERT_TRUE(shown);
        EXPECT_EQ(shown->repeats(), 6);
        EXPECT_EQ(shown->repeats({0, 6, 1, 7, 2}), 2);
    }
}

TEST(SurfaceSampler, WhatIsRememberedChangesNoAnswer) {
    const Fixture f;
    SurfaceSampler sampler(f.views);
    ASSERT_TRUE(sampler.sample(twiceAround(5), JobContext{}));
    const auto later = sampler.sample(twiceAround(40), JobContext{});
    const auto fresh = measureShownSurface(f.views, twiceAround(40), JobContext{});
    ASSERT_TRUE(later && fresh);
    EXPECT_DOUBLE_EQ(later->repeats() / 80.0, fresh->repeat_rate);
    EXPECT_DOUBLE_EQ(later->objectPixels(), fresh->object_pixels);
}

}  // namespace dollytrack::planning::shown_surface_test
