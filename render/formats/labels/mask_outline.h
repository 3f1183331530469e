#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// A closed outline along pixel borders: corners in px, (0, 0) is the image's corner. With y down,
/// the inside is to the right of each edge, so holes run the other way.
struct Outline {
    std::vector<Eigen::Vector2i> corners;
    bool hole = false;
};

/// Exact outlines of a mask (by pixel, row 0 at the top; 0 is outside). Pixels that touch only at a
/// corner are not connected.
[[nodiscard]] std::vector<Outline> outlinesOf(int width, int height,
                                              std::span<const std::uint8_t> mask);

/// The same for a mask in COCO run lengths.
[[nodiscard]] std::vector<Outline> outlinesOfCounts(int width, int height,
                                                    std::span<const std::uint32_t> counts);

}  // namespace dollytrack::render
