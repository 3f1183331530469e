#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

/// A triangle mesh: positions, and triangles as indices into them.
struct SurfaceView {
    std::span<const Eigen::Vector3f> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// Points at which two surfaces touch, intersect or are nearer than `gap`; empty if they nowhere
/// do. Not all such points: vertices are tested against triangles and edges for intersections with
/// triangles, and of dense meshes only a subset is tested.
std::vector<Eigen::Vector3f> findContact(const std::vector<SurfaceView>& a,
                                         const std::vector<SurfaceView>& b, float gap);

}  // namespace dollytrack
