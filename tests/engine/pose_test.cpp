#include "engine/math/pose.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>

#include <numbers>

namespace dollytrack::pose_test {

TEST(Pose, LooksAtItsTargetWithTheWorldsUpAtTheTop) {
    const Pose pose = lookAt({1, 2, 3}, {4, 2, 3});
    EXPECT_TRUE(pose.forward().isApprox(Eigen::Vector3d::UnitX(), 1e-12));
    // Camera y points down in the image, so the world's up is its -y.
    EXPECT_TRUE(
        (pose.rotation * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
    // Looking along +x, the world's -y is to the right.
    EXPECT_TRUE(
        (pose.rotation * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(Pose, StraightDownIsARotationToo) {
    const Eigen::Quaterniond down = lookAlong(-Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(down.toRotationMatrix().determinant(), 1.0, 1e-12);
    EXPECT_TRUE((down * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(Pose, SlerpOfRollFreePosesRollsAndWithoutRollRemovesIt) {
    const Eigen::Quaterniond a = lookAlong({1, 0, 0});
    const double pitch = -std::numbers::pi / 3.0;
    const Eigen::Quaterniond b = lookAlong({0, std::cos(pitch), std::sin(pitch)});
    const Eigen::Quaterniond middle = a.slerp(0.5, b);
    EXPECT_GT(std::abs((middle * Eigen::Vector3d::UnitX()).z()), 0.1);
    const Eigen::Quaterniond level = withoutRoll(middle);
    EXPECT_NEAR((level * Eigen::Vector3d::UnitX()).z(), 0.0, 1e-12);
    EXPECT_TRUE(
        (level * Eigen::Vector3d::UnitZ()).isApprox(middle * Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(Pose, ToCameraUndoesToWorld) {
    Random random(7);
    for (int i = 0; i < 100; ++i) {
        const auto point = [&] {
            return Eigen::Vector3d(random.normal(), random.normal(), random.normal());
        };
        const Pose pose = lookAt(point(), point());
        const Eigen::Vector3d p = point();
        EXPECT_TRUE(pose.toCamera(pose.toWorld(p)).isApprox(p, 1e-9));
        EXPECT_TRUE((pose.worldFromCamera() * p).isApprox(pose.toWorld(p), 1e-9));
    }
}

}  // namespace dollytrack::pose_test
