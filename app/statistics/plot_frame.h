#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::statistics {

/// A mark of an axis, in the axis's own numbers.
struct PlotTick {
    double at = 0.0;
    std::string text;
};

struct PlotAxis {
    double low = 0.0;
    double high = 1.0;
    bool logarithmic = false;
    std::vector<PlotTick> ticks;
    std::string label;  // with the unit
};

/// An SVG drawing with axes. Colours and fonts come from the style of the page. Coordinates are px,
/// x right, y down.
class PlotFrame {
  public:
    static constexpr double kWidth = 380.0;

    PlotFrame(PlotAxis x, PlotAxis y, double plot_height, double left = 40.0);

    [[nodiscard]] double xAt(double value) const;
    [[nodiscard]] double yAt(double value) const;
    [[nodiscard]] double left() const { return left_; }
    [[nodiscard]] double right() const { return kWidth - 12.0; }
    [[nodiscard]] double top() const { return y_.label.empty() ? 4.0 : 22.0; }
    [[nodiscard]] double bottom() const { return top() + plot_height_; }

    /// The whole drawing: axes, grid, and `content` above the grid. `title` is plain text.
    [[nodiscard]] std::string svg(std::string_view title, std::string_view content) const;

  private:
    PlotAxis x_;
    PlotAxis y_;
    double plot_height_ = 0.0;
    double left_ = 0.0;
};

/// Round numbers of an axis. `factor` is shown / stored number.
[[nodiscard]] std::vector<PlotTick> linearTicks(double low, double high, double factor, int count);
/// Powers of ten, or of two as "1/2", "1", "2".
[[nodiscard]] std::vector<PlotTick> powerTicks(double low, double high, double factor, double base);

/// A number with three significant digits and without exponent: "0.032", "12.5", "12,345".
[[nodiscard]] std::string numberText(double value);
/// The same, with its sign: "+12", "−3.1", "±0".
[[nodiscard]] std::string differenceText(double value);

}  // namespace dollytrack::statistics
