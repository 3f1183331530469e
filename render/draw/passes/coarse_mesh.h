#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Simplifies a mesh for fast previews: about an eighth of the triangles, over the same vertices.
/// The surface moves by at most 1 % of the mesh's extent. Meshes of up to 200 triangles stay
/// unchanged. Uses meshoptimizer, after Garland & Heckbert, "Surface Simplification Using Quadric
/// Error Metrics" (1997).
/// @param corners    vertex indices, three per triangle
/// @param vertices   position of the first of `count` vertices; the others follow every `stride`
///     bytes
[[nodiscard]] std::vector<std::uint32_t> coarseMesh(std::span<const std::uint32_t> corners,
                                                    const Eigen::Vector3f& vertices,
                                                    std::size_t count, std::size_t stride);

}  // namespace dollytrack::render
