#include "engine/geometry/oriented_box.h"
#include "engine/core/random.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace dollytrack::oriented_box_test {
namespace {

std::vector<Eigen::Vector3f> cloud(Random& random, std::size_t count, const Eigen::Vector3d& size,
                                   double yaw) {
    std::vector<Eigen::Vector3f> points;
    const Eigen::AngleAxisd turn(yaw, Eigen::Vector3d::UnitZ());
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3d p(random.uniform(-0.5, 0.5) * size.x(),
                                random.uniform(-0.5, 0.5) * size.y(),
                                random.uniform(0.0, 1.0) * size.z());
        points.emplace_back((turn * p + Eigen::Vector3d(3, -2, 1)).cast<float>());
    }
    return points;
}

/// The smallest rectangle over rotations in steps of 0.1 degrees.
double bruteForceArea(const std::vector<Eigen::Vector3f>& points) {
    double best = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 900; ++step) {
        const double yaw = step * std::numbers::pi / 1800.0;
        const Eigen::Matrix2d turn = Eigen::Rotation2Dd(-yaw).toRotationMatrix();
        Eigen::AlignedBox2d box;
        for (const auto& p : points) box.extend(turn * p.head<2>().cast<double>());
        best = std::min(best, box.sizes().prod());
    }
    return best;
}

TEST(OrientedBox, IsAsSmallAsBruteForceAndHoldsEveryPoint) {
    Random random(11);
    for (const std::size_t count : {5U, 40U, 3000U}) {
        for (int round = 0; round < 10; ++round) {
            const auto points = cloud(random, count, {2.0, 0.7, 1.1}, random.uniform(0.0, 3.0));
            const OrientedBox box = fitUprightBox(points, 0.0);
            const double area = 4.0 * box.half_size.x() * box.half_size.y();
            EXPECT_LE(area, bruteForceArea(points) + 1e-6);
            for (const auto& p : points) EXPECT_TRUE(box.contains(p.cast<double>(), 1e-5));
        }
    }
}

TEST(OrientedBox, FindsTheYawOfATurnedBox) {
    for (const double yaw : {-0.7, -0.2, 0.1, 0.6}) {
        OrientedBox truth;
        truth.half_size = {1.0, 0.4, 0.3};
        truth.yaw = yaw;
        std::vector<Eigen::Vector3f> points;
        for (const auto& corner : truth.corners()) points.push_back(corner.cast<float>());
        const OrientedBox box = fitUprightBox(points);
        EXPECT_NEAR(box.yaw, yaw, 1e-5);
        EXPECT_TRUE(box.half_size.isApprox(truth.half_size, 1e-5));
    }
}

TEST(OrientedBox, IsExactlyAlignedWhenThatIsAsGood) {
    Random random(2);
    auto points = cloud(random, 500, {1.0, 1.0, 1.0}, 0.0);
    for (const auto& corner : {Eigen::Vector2f(2.5, -2.5), Eigen::Vector2f(3.5, -2.5),
                               Eigen::Vector2f(3.5, -1.5), Eigen::Vector2f(2.5, -1.5)}) {
        points.emplace_back(corner.x(), corner.y(), 1.0F);
    }
    EXPECT_EQ(fitUprightBox(points).yaw, 0.0);
}

TEST(OrientedBox, TakesAPlaneSeenFromAbove) {
    const std::vector<Eigen::Vector3f> picture = {{0, 0, 1}, {1, 1, 1}, {1, 1, 2}, {0, 0, 2}};
    const OrientedBox box = fitUprightBox(picture);
    EXPECT_NEAR(box.half_size.head<2>().minCoeff(), 0.0, 1e-6);
    EXPECT_NEAR(box.half_size.head<2>().maxCoeff(), std::sqrt(0.5), 1e-6);
}

}  // namespace
}  // namespace dollytrack::oriented_box_test
