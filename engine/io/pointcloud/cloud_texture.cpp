#include "engine/io/pointcloud/cloud_texture.h"

#include "engine/io/pointcloud/point_grid.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack {
namespace {

constexpr std::size_t kSquare = 4;        // texels
constexpr std::size_t kLargestRow = 512;  // squares: 2048 texels, the largest texture size
constexpr std::uint8_t kGrey = 128;       // without a colour nearby

}  // namespace

CloudTexture::CloudTexture(std::size_t triangles) : triangles_(triangles) {
    const auto row = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(triangles))));
    per_row_ = std::clamp<std::size_t>(row, 1, kLargestRow);
    per_picture_ = per_row_ * per_row_;
    pictures_ = (triangles + per_picture_ - 1) / per_picture_;
}

std::size_t CloudTexture::pictureOf(std::size_t triangle) const {
    return triangle / per_picture_;
}

Eigen::Vector2f CloudTexture::uv(std::size_t triangle, std::size_t corner) const {
    const std::size_t square = triangle % per_picture_;
    // Corners are at texel centres, so that filtering does not mix in neighbouring squares.
    const double x =
        static_cast<double>(square % per_row_ * kSquare) + (corner == 1 ? kSquare - 0.5 : 0.5);
    const double y =
        static_cast<double>(square / per_row_ * kSquare) + (corner == 2 ? kSquare - 0.5 : 0.5);
    const auto side = static_cast<double>(per_row_ * kSquare);
    return {static_cast<float>(x / side), static_cast<float>(1.0 - y / side)};
}

std::vector<TextureRequest> CloudTexture::paint(std::span<const Eigen::Vector3d> corners,
                                                const PointCloud& cloud_m, double reach_m) const {
    const std::size_t side = per_row_ * kSquare;
    std::vector<TextureRequest> pictures(pictures_);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        pictures[i].name = "colours of the points " + std::to_string(i + 1);
        pictures[i].embedded_width = static_cast<int>(side);
        pictures[i].embedded_height = static_cast<int>(side);
        pictures[i].embedded.assign(side * side * 4, 255);
    }
    const PointGrid grid(cloud_m.points, reach_m);
    parallelFor(triangles_, [&](std::size_t t) {
        const Eigen::Vector3d& a = corners[3 * t];
        const Eigen::Vector3d along = (corners[3 * t + 1] - a) / (kSquare - 1.0);
        const Eigen::Vector3d across = (corners[3 * t + 2] - a) / (kSquare - 1.0);
        const std::size_t square = t % per_picture_;
        std::array<std::size_t, 3> at_corner{};
        for (std::size_t i = 0; i < 3; ++i) at_corner[i] = grid.nearest(corners[3 * t + i]);
        std::vector<std::uint8_t>& rgba = pictures[pictureOf(t)].embedded;
        for (std::size_t y = 0; y < kSquare; ++y) {
            for (std::size_t x = 0; x < kSquare; ++x) {
                std::size_t nearest = grid.nearest(a + static_cast<double>(x) * along +
                                                   static_cast<double>(y) * across);
                // In a filled hole only the corners have points nearby.
                if (nearest >= cloud_m.colors.size()) {
                    nearest = at_corner[2 * x >= kSquare ? 1 : 2 * y >= kSquare ? 2 : 0];
                }
                const std::size_t row = square / per_row_ * kSquare + y;
                const std::size_t column = square % per_row_ * kSquare + x;
                for (std::size_t c = 0; c < 3; ++c) {
                    rgba[4 * (row * side + column) + c] =
                        nearest < cloud_m.colors.size() ? cloud_m.colors[nearest][c] : kGrey;
                }
            }
        }
    });
    return pictures;
}

}  // namespace dollytrack
