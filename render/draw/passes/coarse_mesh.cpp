#include "render/draw/passes/coarse_mesh.h"

#include <meshoptimizer.h>

namespace dollytrack::render {
namespace {

constexpr std::size_t kFewCorners = 3 * 200;
constexpr std::size_t kShare = 8;
constexpr float kFarthest = 0.01F;

}  // namespace

std::vector<std::uint32_t> coarseMesh(std::span<const std::uint32_t> corners,
                                      const Eigen::Vector3f& vertices, std::size_t count,
                                      std::size_t stride) {
    std::vector<std::uint32_t> coarse(corners.begin(), corners.end());
    if (corners.size() <= kFewCorners) return coarse;
    coarse.resize(meshopt_simplify(coarse.data(), corners.data(), corners.size(), vertices.data(),
                                   count, stride, corners.size() / kShare / 3 * 3, kFarthest, 0,
                                   nullptr));
    return coarse;
}

}  // namespace dollytrack::render
