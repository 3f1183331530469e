#pragma once

#include "render/verify/read/image_files.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

// Masks column by column, width * height bytes, not 0 inside.
namespace dollytrack::verify {

/// The pixels that show one object.
std::vector<std::uint8_t> shownBy(const Image16& ids, int object_id);

/// Adds the pixels whose centres lie inside a polygon: x and y of its corners in turn, px, (0, 0)
/// the image's corner.
void fillPolygon(std::span<const double> corners, int width, int height,
                 std::vector<std::uint8_t>& mask);

/// How many pixels each part of a mask has; pixels that touch at a corner alone are apart.
std::vector<int> partSizes(const std::vector<std::uint8_t>& mask, int width, int height);

/// Why an outlined area is not a whole part of a mask, with what that encloses, of the largest
/// number of pixels; empty when it is.
std::string partProblem(const std::vector<std::uint8_t>& outlined,
                        const std::vector<std::uint8_t>& mask, int width, int height);

/// The mask and all that one of its parts encloses.
std::vector<std::uint8_t> withoutHoles(const std::vector<std::uint8_t>& mask, int width,
                                       int height);

}  // namespace dollytrack::verify
