#pragma once

#include "render/draw/view.h"

#include <Eigen/Geometry>

#include <cstdint>

namespace dollytrack::render {

/// Pixels, first included, last not.
struct PixelRect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
    [[nodiscard]] std::int64_t area() const { return std::int64_t{width()} * height(); }
};

/// The pixels a box covers, cut at `limits`; all of them when it reaches behind the near plane.
[[nodiscard]] PixelRect projectBox(const Eigen::AlignedBox3f& box, const View& view,
                                   const PixelRect& limits);

/// A part of the view's image as a view of its own: the same rays through the same pixels.
/// @param step  one row and column in the place of so many; divides the rectangle's sides
[[nodiscard]] View cutOut(const View& view, const PixelRect& rect, int step = 1);

}  // namespace dollytrack::render
