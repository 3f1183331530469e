#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace dollytrack {

/// Triangles that fill the holes of a mesh of at most `widest_m` width. The longest boundary of
/// each connected component is its outline and not filled. Adjacent triangles must have consistent
/// orientation. `holes` is increased by the number of filled holes.
std::vector<Triangle> fillHoles(std::span<const Eigen::Vector3d> points,
                                std::span<const Triangle> triangles, double widest_m,
                                std::size_t& holes);

}  // namespace dollytrack
