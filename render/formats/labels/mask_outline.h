#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// A closed outline along the borders of pixels: corners in px, (0, 0) the image's corner. What is
/// inside lies to the right of each edge, seen with y down; holes therefore run the other way.
struct Outline {
    std::vector<Eigen::Vector2i> corners;
    bool hole = false;
};

/// The outlines of a mask (by pixel, rows from the top; 0 is outside), exact to the pixel. Pixels
/// that touch at a corner alone are apart.
[[nodiscard]] std::vector<Outline> outlinesOf(int width, int height,
                                              std::span<const std::uint8_t> mask);

/// The same of run lengths as COCO's.
[[nodiscard]] std::vector<Outline> outlinesOfCounts(int width, int height,
                                                    std::span<const std::uint32_t> counts);

}  // namespace dollytrack::render
