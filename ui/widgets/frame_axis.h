#pragma once

#include <cstddef>
#include <vector>

namespace dollytrack::ui {

/// Frames along the x axis of a timeline. Frame i covers [i, i + 1) of the axis; zoom and scroll
/// choose which part of 0..count lies between `left` and `right` on the screen (px).
class FrameAxis {
  public:
    FrameAxis(int count, double left, double right, double first, double shown);

    [[nodiscard]] double left() const { return left_; }
    [[nodiscard]] double right() const { return right_; }
    [[nodiscard]] double first() const { return first_; }  // in frames
    [[nodiscard]] double shown() const { return shown_; }
    [[nodiscard]] double pixelsPerFrame() const { return (right_ - left_) / shown_; }

    /// Where a place on the axis, in frames, is on the screen. A frame's middle is at i + 0.5.
    [[nodiscard]] double xOf(double place) const;
    [[nodiscard]] double placeAt(double x) const;
    /// The frame under a screen position; outside, the nearest one.
    [[nodiscard]] int frameAt(double x) const;

    /// One past the last frame of which anything is shown.
    [[nodiscard]] int endFrame() const;

    /// Shows `factor` times as many frames, keeping what is under x in its place.
    void zoom(double x, double factor);
    void pan(double pixels);
    /// Scrolls as little as needed to show the frame.
    void reveal(int frame);

  private:
    void clamp();

    int count_;
    double left_, right_;
    double first_, shown_;
};

/// The range of the values that fall onto one column of pixels.
struct PlotColumn {
    double low = 0.0;
    double high = 0.0;
    double last = 0.0;  // of the last of its frames, where the next column goes on
};

/// One a pixel between the axis's ends, beginning at its left end. No value is lost: a spike of one
/// frame among thousands still reaches its full height. `value(i)` is read for 0 <= i < count.
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
        // The frame that the next column begins in counts there, unless this is the last.
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
