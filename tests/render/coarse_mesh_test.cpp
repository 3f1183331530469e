#include "render/draw/passes/coarse_mesh.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::render::coarse_mesh_test {
namespace {

struct Ball {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::uint32_t> corners;
};

/// A ball of radius 1 with this many rings.
Ball makeBall(std::uint32_t rings) {
    Ball ball;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        for (std::uint32_t k = 0; k < 2 * rings; ++k) {
            const float up = std::numbers::pi_v<float> * static_cast<float>(i) / rings;
            const float around = std::numbers::pi_v<float> * static_cast<float>(k) / rings;
            ball.vertices.emplace_back(std::sin(up) * std::cos(around),
                                       std::sin(up) * std::sin(around), std::cos(up));
        }
    }
    const std::uint32_t row = 2 * rings;
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t k = 0; k < row; ++k) {
            const std::uint32_t next = (k + 1) % row;
            const std::uint32_t a = i * row + k;
            const std::uint32_t b = i * row + next;
            for (const std::uint32_t corner : {a, b, a + row, b, b + row, a + row}) {
                ball.corners.push_back(corner);
            }
        }
    }
    return ball;
}

std::vector<std::uint32_t> coarseOf(const Ball& ball) {
    return coarseMesh(ball.corners, ball.vertices.front(), ball.vertices.size(),
                      sizeof(Eigen::Vector3f));
}

TEST(CoarseMesh, HasFarFewerTrianglesThatStayByTheSurface) {
    const Ball ball = makeBall(60);
    const std::vector<std::uint32_t> coarse = coarseOf(ball);
    ASSERT_EQ(coarse.size() % 3, 0U);
    EXPECT_LT(coarse.size(), ball.corners.size() / 6);
    EXPECT_GT(coarse.size(), 300U);
    ASSERT_LT(*std::ranges::max_element(coarse), ball.vertices.size());
    double area = 0.0;
    for (std::size_t i = 0; i < coarse.size(); i += 3) {
        const Eigen::Vector3f& a = ball.vertices[coarse[i]];
        const Eigen::Vector3f& b = ball.vertices[coarse[i + 1]];
        const Eigen::Vector3f& c = ball.vertices[coarse[i + 2]];
        EXPECT_GT(((a + b + c) / 3.0F).norm(), 0.94F);  // corners are on the ball
        area += 0.5 * static_cast<double>((b - a).cross(c - a).norm());
    }
    EXPECT_NEAR(area, 4.0 * std::numbers::pi, 0.4);
}

TEST(CoarseMesh, LeavesSmallMeshesAlone) {
    const Ball ball = makeBall(6);
    EXPECT_EQ(coarseOf(ball), ball.corners);
}

}  // namespace
}  // namespace dollytrack::render::coarse_mesh_test
