#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

/// One normal for each corner of each triangle (three per triangle, in order). Faces that share a
/// position and meet at less than `crease_deg` are smoothed together, weighted by area. If
/// `place_out` is given it receives a number for each position: equal positions have equal numbers,
/// counted from 0.
std::vector<Eigen::Vector3f> cornerNormals(std::span<const Eigen::Vector3f> positions,
                                           std::span<const std::array<std::uint32_t, 3>> triangles,
                                           double crease_deg = 45.0,
                                           std::vector<std::uint32_t>* place_out = nullptr);

}  // namespace dollytrack
