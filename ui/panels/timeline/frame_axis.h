#pragma once

#include <cstddef>
#include <vector>

namespace dollytrack::ui {

/// The horizontal frame axis of a timeline. Frame i covers [i, i + 1); zoom and scroll choose the
/// part of the axis that lies between `left` and `right` (px on the screen). The axis is 0..count
/// with room for `margin` more frames after the last one. At least 8 frames are shown, if there are
/// that many.
class FrameAxis {
  public:
    FrameAxis(int count, double left, double right, double first, double shown,
              double margin = 0.0);

    [[nodiscard]] double left() const { return left_; }
    [[nodiscard]] double right() const { return right_; }
    [[nodiscard]] double first() const { return first_; }  // in frames, may be fractional
    [[nodiscard]] double shown() const { return shown_; }
    [[nodiscard]] double margin() const { return length_ - count_; }
    /// Whether only a part of the axis is visible.
    [[nodiscard]] bool isZoomed() const { return shown_ < length_; }
    [[nodiscard]] double pixelsPerFrame() const { return (right_ - left_) / shown_; }

    /// Screen position (px) of an axis position in frames. A frame's centre is at i + 0.5.
    [[nodiscard]] double xOf(double place) const;
    [[nodiscard]] double placeAt(double x) const;
    /// The frame at a screen position, clamped to the trajectory.
    [[nodiscard]] int frameAt(double x) const;

    /// One past the last visible frame.
    [[nodiscard]] int endFrame() const;

    /// Multiplies the visible range by `factor`; the axis position at x stays in place.
    void zoom(double x, double factor);
    void pan(double pixels);
    /// Scrolls by the smallest amount that shows the frame.
    void reveal(int frame);

  private:
    void clamp();

    int count_;
    double length_;  // of the axis, in frames
    double left_, right_;
    double first_, shown_;
};

/// Minimum, maximum and last value of the frames in one column of pixels.
struct PlotColumn {
    double low = 0.0;
    double high = 0.0;
    double last = 0.0;  // value of the column's last frame, where the next column continues
};

/// One column per pixel, from the axis's left end. Every visible value is included: a spike of one
/// frame among thousands keeps its full height. `value(i)` is called for 0 <= i < count.
template <class Value>
std::vector<PlotColumn> plotColumns(const FrameAxis& axis, int count, const Value& value) {
    std::vector<PlotColumn> columns;
    if (count <= 0) return columns;
    const auto width = static_cast<std::size_t>(axis.right() - axis.left());
    columns.reserve(width);
    for (std::size_t x = 0; x < width; ++x) {
        const double begin = axis.placeAt(axis.left() + static_cast<double>(x));
        if (begin >= count) break;
        const int from = axis.frameAt(axis.left() + static_cast<double>(x));
        const int to = axis.frameAt(axis.left() + static_cast<double>(x + 1));
        const auto first = static_cast<double>(value(from));
        PlotColumn column{first, first, first};
        // A frame that continues in the next column counts there, except in the last column.
        const int end = x + 1 == width ? axis.endFrame() : to;
        for (int i = from + 1; i < end; ++i) {
            const auto v = static_cast<double>(value(i));
            if (v < column.low) column.low = v;
            if (v > column.high) column.high = v;
            column.last = v;
        }
        columns.push_back(column);
    }
    return columns;
}

}  // namespace dollytrack::ui
