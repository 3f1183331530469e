#include "planning/visibility/view_estimator.h"

#include "planning/visibility/framing.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::planning::view_estimator_test {
namespace {

// A 1 x 1 m board seen squarely from 2 m, its right half behind a nearer board.
Scene halfHidden() {
    test::SceneBuilder builder;
    builder.object("board").box({3.0, 0, 0}, {0.001, 1.0, 1.0});
    builder.object("screen").box({2.0, -1.0, 0}, {0.001, 2.0, 4.0});
    return builder.build();
}

}  // namespace

TEST(ViewEstimator, CountsOcclusionAnalytically) {
    const Scene scene = halfHidden();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, {});
    const auto estimate = views.estimate(lookAt({1, 0, 0}, {3, 0, 0}), 1, 64);
    EXPECT_NEAR(estimate.visible_fraction, 0.5, 0.02);
    EXPECT_EQ(estimate.occluder, 2);
    EXPECT_FALSE(estimate.cropped);
    // 1 m at 2 m: f = 320 / tan 30 deg = 554.26 px a metre at 1 m; half of it is seen.
    const double side = 320.0 / std::tan(std::numbers::pi / 6.0) / 2.0;
    EXPECT_NEAR(estimate.mask_share, 0.5 * side * side / (640.0 * 480.0), 0.01);
    EXPECT_NEAR(estimate.box_share, 0.5 * side * side / (640.0 * 480.0), 0.01);
}

TEST(ViewEstimator, CroppingCountsAgainstTheWholeSilhouette) {
    test::SceneBuilder builder;
    builder.object("board").box({3.0, 0, 0}, {0.001, 1.0, 1.0});
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, {});
    // Turned so that the image's left edge cuts the board in the middle: the board's centre lies
    // 30 degrees to the left of the viewing direction.
    const double a = std::numbers::pi / 6.0;
    const Pose pose{{1, 0, 0}, lookAlong({std::cos(a), -std::sin(a), 0.0})};
    const auto estimate = views.estimate(pose, 1, 64);
    EXPECT_TRUE(estimate.cropped);
    // A flat board projects to a quadrilateral; the part with y < 0 is inside the image.
    const auto area = [&](double y_low, double y_high) {
        std::array<Eigen::Vector2d, 4> px;
        std::size_t i = 0;
        for (const auto& [y, z] :
             {std::pair{y_low, -0.5}, {y_high, -0.5}, {y_high, 0.5}, {y_low, 0.5}}) {
            px[i++] = views.intrinsics().project(pose.toCamera({2.9995, y, z}));
        }
        double twice = 0.0;
        for (i = 0; i < 4; ++i) {
            const auto& from = px[i];
            const auto& to = px[(i + 1) % 4];
            twice += from.x() * to.y() - to.x() * from.y();
        }
        return 0.5 * std::abs(twice);
    };
    EXPECT_NEAR(estimate.visible_fraction, area(-0.5, 0.0) / area(-0.5, 0.5), 0.02);
}

TEST(ViewEstimator, BehindTheCameraIsNotSeen) {
    test::SceneBuilder builder;
    builder.object("board").box({3.0, 0, 0}, {0.001, 1.0, 1.0});
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, {});
    EXPECT_EQ(views.estimate(lookAt({4, 0, 0}, {6, 0, 0}), 1, 16).visible_fraction, 0.0);
}

// Checks the corrected Equation 1: projecting the box's corners from the distance found gives the
// requested fill.
TEST(Framing, DistanceForFillFillsTheImageAsAsked) {
    test::SceneBuilder builder;
    builder.object("crate").box({0, 0, 0}, {0.6, 0.9, 0.3});
    const Scene scene = builder.build();
    const RayCaster rays(scene);
    const ViewEstimator views(scene, rays, {});
    const Subject subject = makeSubject(views, {1});
    for (const double fill : {0.35, 0.6, 0.85}) {
        for (const Eigen::Vector3d& direction :
             {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.6, -0.6, 0.5).normalized(),
              Eigen::Vector3d(0.1, 0.2, 0.97).normalized()}) {
            const double distance = distanceForFill(views, subject, direction, fill);
            const Pose pose = lookAt(direction * distance, {0, 0, 0});
            double reached = 0.0;
            for (const Eigen::Vector3d& corner : scene.object(1).box.corners()) {
                const Eigen::Vector2d px = views.intrinsics().project(pose.toCamera(corner));
                reached = std::max(
                    {reached, std::abs(px.x() - 320.0) / 320.0, std::abs(px.y() - 240.0) / 240.0});
            }
            EXPECT_NEAR(reached, fill, 0.06 * fill);
        }
    }
}

}  // namespace dollytrack::planning::view_estimator_test
