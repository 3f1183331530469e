#include "engine/io/pointcloud/cloud_scatter.h"

#include "engine/core/random.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dollytrack::cloud_scatter_test {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// `count` points of a slanted plane of 2 x 2 m, with normal noise.
Points plane(int count, double noise_m) {
    Random random(5);
    const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
    const Eigen::Vector3d u = normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    Points points;
    for (int i = 0; i < count; ++i) {
        points.emplace_back(random.uniform(-1, 1) * u + random.uniform(-1, 1) * v +
                            noise_m * random.normal() * normal);
    }
    return points;
}

/// Deviation of the inner points, which have neighbours on all sides.
double deviation(const Points& points) {
    const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
    double squares = 0.0;
    int count = 0;
    for (const Eigen::Vector3d& p : points) {
        if (p.norm() > 0.8) continue;
        squares += std::pow(normal.dot(p), 2);
        ++count;
    }
    return std::sqrt(squares / count);
}

TEST(CloudScatter, SpacingIsThatOfGridsAndOfRandomPoints) {
    Points grid;
    for (int i = 0; i < 100; ++i) {
        for (int j = 0; j < 100; ++j) grid.emplace_back(0.03 * i, 0.03 * j, 0.0);
    }
    EXPECT_NEAR(spacingOf(grid, 0.002), 0.03, 0.002);
    // 10,000 points on 4 m2: one every 2 cm.
    EXPECT_NEAR(spacingOf(plane(10'000, 0.0), 0.002), 0.02, 0.002);
    EXPECT_NEAR(spacingOf(plane(10'000, 0.0), 0.2), 0.02, 0.002);
}

TEST(CloudScatter, IsTheNoiseThatWasPutIn) {
    for (const double noise : {0.0, 0.002, 0.01, 0.03}) {
        const Scatter scatter = scatterOf(plane(40'000, noise), 0.06);
        EXPECT_NEAR(scatter.sigma_m, noise, 0.15 * noise + 1e-9) << noise;
        EXPECT_GE(scatter.radius_m, noise / 0.2) << noise;
    }
}

TEST(CloudScatter, SmoothedPointsLieOnTheirPlane) {
    Points points = plane(40'000, 0.02);
    EXPECT_NEAR(deviation(points), 0.02, 0.001);
    smoothScatter(points, scatterOf(points, 0.06).radius_m, {});
    EXPECT_LT(deviation(points), 0.002);
    // With too few neighbours points move less, even with the smallest radius.
    Points near = plane(40'000, 0.02);
    smoothScatter(near, 0.02, {});
    EXPECT_GT(deviation(near), 0.005);
}

TEST(CloudScatter, PlanesStayWhereTheyAre) {
    const Points before = plane(5'000, 0.0);
    Points after = before;
    smoothScatter(after, 0.1, {});
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LT((before[i] - after[i]).norm(), 1e-9);
    }
}

}  // namespace
}  // namespace dollytrack::cloud_scatter_test
