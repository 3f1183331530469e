#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

/// One normal for each corner of each triangle (three per triangle, in order). Faces that share a
/// position and meet at less than `crease_deg` are smoothed together, weighted by area.
/// `place_out`, if given, receives a number for each position, equal for equal positions and below
/// their count.
std::vector<Eigen::Vector3f> cornerNormals(std::span<const Eigen::Vector3f> positions,
                                           std::span<const std::array<std::uint32_t, 3>> triangles,
                                           double crease_deg = 45.0,
                                           std::vector<std::uint32_t>* place_out = nullptr);

}  // namespace dollytrack
