#pragma once

#include "render/verify/read/image_files.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

// Masks are stored column by column, width * height bytes, nonzero inside.
namespace dollytrack::verify {

/// Mask of the pixels with this object id.
std::vector<std::uint8_t> shownBy(const Image16& ids, int object_id);

/// Adds the pixels whose centres lie inside a polygon. `corners` alternates x and y, px; (0, 0) is
/// the image's corner.
void fillPolygon(std::span<const double> corners, int width, int height,
                 std::vector<std::uint8_t>& mask);

/// Size in pixels of each connected part of a mask. Pixels that touch only at a corner are not
/// connected.
std::vector<int> partSizes(const std::vector<std::uint8_t>& mask, int width, int height);

/// Checks that an outlined area is one whole part of a mask with its holes filled, and a largest
/// one. Returns the problem, or an empty text.
std::string partProblem(const std::vector<std::uint8_t>& outlined,
                        const std::vector<std::uint8_t>& mask, int width, int height);

/// The mask with the holes of its connected components filled.
std::vector<std::uint8_t> withoutHoles(const std::vector<std::uint8_t>& mask, int width,
                                       int height);

}  // namespace dollytrack::verify
