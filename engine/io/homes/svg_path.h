#pragma once

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace dollytrack::homes {

/// Converts an SVG path in the unit square (y down) to polygons; curves become line segments.
/// Supports M L H V C S Q T A Z, absolute and relative (SVG 1.1, section 8.3). The path ends at the
/// first invalid command. Outlines of fewer than three points are left out.
std::vector<std::vector<Eigen::Vector2d>> outlinesOfPath(std::string_view path);

}  // namespace dollytrack::homes
