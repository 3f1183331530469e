#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace dollytrack::io {

/// Triangles over the holes of a surface that are at most `widest_m` across; the outline of each
/// connected piece (its longest rim) is no hole. Triangles must be wound alike where they meet.
/// `holes` counts what was filled.
std::vector<Triangle> fillHoles(std::span<const Eigen::Vector3d> points,
                                std::span<const Triangle> triangles, double widest_m,
                                std::size_t& holes);

}  // namespace dollytrack::io
