#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Fewer triangles over the same vertices, for pictures that must come fast: about an eighth of
/// them, no farther from the surface than a hundredth of the thing's size. Small meshes stay as
/// they are. Garland & Heckbert's quadrics (1997), by meshoptimizer.
/// @param corners    three a triangle, indices of vertices
/// @param vertices   the first one's position; the others follow every `stride` bytes
[[nodiscard]] std::vector<std::uint32_t> coarseMesh(std::span<const std::uint32_t> corners,
                                                    const Eigen::Vector3f& vertices,
                                                    std::size_t count, std::size_t stride);

}  // namespace dollytrack::render
