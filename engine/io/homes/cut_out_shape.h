#pragma once

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace dollytrack::homes {

/// The outlines that an SVG path draws in the unit square (y down), curves as short straight
/// pieces: M L H V C S Q T A Z, absolute and relative (SVG 1.1, section 8.3). What cannot be read
/// ends the path there; a path of nothing gives nothing.
std::vector<std::vector<Eigen::Vector2d>> outlinesOfPath(std::string_view path);

}  // namespace dollytrack::homes
