#pragma once

#include "render/view/view.h"

#include <Eigen/Geometry>

#include <cstdint>

namespace dollytrack::render {

/// A rectangle of pixels; x1 and y1 are exclusive.
struct PixelRect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
    [[nodiscard]] std::int64_t area() const { return std::int64_t{width()} * height(); }
};

/// Pixels that a box may cover, clipped to `limits`; all of `limits` if the box reaches behind the
/// near plane.
[[nodiscard]] PixelRect projectBox(const Eigen::AlignedBox3f& box, const View& view,
                                   const PixelRect& limits);

/// A part of a view's image as its own view, with the same rays through the same pixels.
/// @param step  keeps one row and column in `step`; must divide the rectangle's width and height
[[nodiscard]] View cutOut(const View& view, const PixelRect& rect, int step = 1);

}  // namespace dollytrack::render
