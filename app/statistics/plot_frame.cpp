#include "app/statistics/plot_frame.h"

#include "app/batch/markup.h"
#include "render/plots/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::statistics {
namespace {

constexpr double kBelow = 40.0;  // px below the plot, for numbers and label

/// `share` of the way along the axis.
double along(const PlotAxis& axis, double value) {
    const auto place = [&axis](double at) { return axis.logarithmic ? std::log(at) : at; };
    const double low = place(axis.low);
    const double high = place(axis.high);
    return high > low ? std::clamp((place(value) - low) / (high - low), 0.0, 1.0) : 0.0;
}

/// A whole number with commas.
std::string grouped(double value) {
    const std::string digits = fmt::format("{:.0f}", value);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
        text += digits[i];
    }
    return text;
}

}  // namespace

PlotFrame::PlotFrame(PlotAxis x, PlotAxis y, double plot_height, double left)
    : x_(std::move(x)), y_(std::move(y)), plot_height_(plot_height), left_(left) {}

double PlotFrame::xAt(double value) const {
    return left() + (right() - left()) * along(x_, value);
}

double PlotFrame::yAt(double value) const {
    return bottom() - (bottom() - top()) * along(y_, value);
}

std::string PlotFrame::svg(std::string_view title, std::string_view content) const {
    std::string grid;
    std::string text;
    for (const PlotTick& tick : y_.ticks) {
        const double y = yAt(tick.at);
        grid += fmt::format("M{:.1f} {:.1f}H{:.1f}", left(), y, right());
        text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"y\">{}</text>", left() - 6.0,
                            y + 4.0, batch::asMarkup(tick.text));
    }
    for (const PlotTick& tick : x_.ticks) {
        const double x = xAt(tick.at);
        grid += fmt::format("M{:.1f} {:.1f}v4", x, bottom());
        text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"x\">{}</text>", x,
                            bottom() + 16.0, batch::asMarkup(tick.text));
    }
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"x label\">{}</text>",
                        0.5 * (left() + right()), bottom() + 33.0, batch::asMarkup(x_.label));
    if (!y_.label.empty()) {
        text += fmt::format("<text x=\"{:.1f}\" y=\"12\" class=\"label\">{}</text>",
                            std::max(0.0, left() - 34.0), batch::asMarkup(y_.label));
    }
    return fmt::format(
        "<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\"><path class=\"grid\" "
        "d=\"{}\"/>{}<path class=\"base\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>{}</svg>",
        kWidth, bottom() + kBelow, batch::asMarkup(title), grid, content, left(), bottom(), right(),
        text);
}

std::vector<PlotTick> linearTicks(double low, double high, double factor, int count) {
    std::vector<PlotTick> ticks;
    const double slack = 1e-6 * (high - low) * factor;
    for (const double at : render::roundTicks(low * factor, high * factor, count)) {
        if (at < low * factor - slack || at > high * factor + slack) continue;
        ticks.push_back({at / factor, numberText(at)});
    }
    return ticks;
}

std::vector<PlotTick> powerTicks(double low, double high, double factor, double base) {
    std::vector<PlotTick> ticks;
    const auto power = [base](double value) { return std::log(value) / std::log(base); };
    const int first = static_cast<int>(std::ceil(power(low * factor) - 1e-6));
    const int last = static_cast<int>(std::floor(power(high * factor) + 1e-6));
    const int step = std::max(1, (last - first + 7) / 8);
    for (int i = first; i <= last; i += step) {
        const double shown = std::pow(base, i);
        const bool fraction = base == 2.0 && i < 0;
        ticks.push_back({shown / factor, fraction ? fmt::format("1/{:.0f}", std::pow(base, -i))
                                                  : numberText(shown)});
    }
    return ticks;
}

std::string numberText(double value) {
    const double size = std::abs(value);
    std::string text = "0";
    if (size >= 999.5) {  // rounded to 1,000
        text = grouped(size);
    } else if (size > 0.0) {
        const int digits = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
        text = fmt::format("{:.{}f}", size, digits);
        if (text.find('.') != std::string::npos) {
            text.erase(text.find_last_not_of('0') + 1);
            if (text.back() == '.') text.pop_back();
        }
    }
    return value < 0.0 && text != "0" ? fmt::format("\u2212{}", text) : text;
}

std::string differenceText(double value) {
    const std::string text = numberText(value);
    if (text == "0") return "±0";
    return value > 0.0 ? fmt::format("+{}", text) : text;
}

}  // namespace dollytrack::statistics
