#include "render/plots/figure.h"

#include "engine/io/files/durable_file.h"
#include "render/plots/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::render {
namespace {

using Eigen::Vector2d;

constexpr int kWidth = 860;
constexpr int kTitleHeight = 46;
constexpr int kChartHeight = 380;
constexpr int kBarHeight = 20;
constexpr int kBarHead = 44;
constexpr int kBarColumns = 2;
constexpr Ink kBlack = {30, 30, 30};
constexpr Ink kGrey = {120, 120, 120};
constexpr Ink kPale = {225, 225, 225};
// Distinguishable with colour blindness (Okabe and Ito, 2008).
constexpr std::array<Ink, 7> kInks = {{{0, 114, 178},
                                       {213, 94, 0},
                                       {0, 158, 115},
                                       {204, 121, 167},
                                       {230, 159, 0},
                                       {86, 180, 233},
                                       {90, 90, 90}}};

Ink inkOf(std::size_t i) {
    return kInks[i % kInks.size()];
}

/// Range of finite values; 0..1 if there are none.
class Range {
  public:
    void add(double value) {
        if (!std::isfinite(value)) return;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    [[nodiscard]] double low() const { return low_ <= high_ ? low_ : 0.0; }
    [[nodiscard]] double high() const { return low_ <= high_ ? high_ : 1.0; }

  private:
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

struct Axis {
    std::vector<double> ticks;
    double from = 0.0;  // px
    double to = 0.0;
    [[nodiscard]] double at(double value) const {
        return from + (to - from) * (value - ticks.front()) / (ticks.back() - ticks.front());
    }
};

void drawCurve(Canvas& canvas, const Curve& curve, const Axis& x, const Axis& y, Ink ink) {
    std::vector<Vector2d> run;
    const auto flush = [&] {
        if (run.size() > 1) canvas.line(run, ink, 2.0);
        run.clear();
    };
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const bool known = curve.y[i] && std::isfinite(*curve.y[i]) && std::isfinite(curve.x[i]);
        if (!known) {
            flush();
            continue;
        }
        run.emplace_back(x.at(curve.x[i]), y.at(*curve.y[i]));
        canvas.dot(run.back(), 3.0, ink);
    }
    flush();
}

void drawChart(Canvas& canvas, const Chart& chart, double top) {
    Range x_range;
    Range y_range;
    y_range.add(0.0);  // the axis includes 0, so that small changes do not look like jumps
    for (const Curve& curve : chart.curves) {
        for (const double x : curve.x) x_range.add(x);
        for (const auto& y : curve.y) y_range.add(y.value_or(0.0));
    }
    // The longest name fits beside its symbol, in 12 px letters.
    std::size_t letters = 0;
    for (const Curve& curve : chart.curves) letters = std::max(letters, curve.name.size());
    const double legend_width =
        std::clamp(60.0 + 7.2 * static_cast<double>(letters), 190.0, 0.5 * kWidth);
    const double bottom = top + kChartHeight - 60.0;
    const Axis x{roundTicks(x_range.low(), x_range.high(), 10), 70.0, kWidth - 20.0 - legend_width};
    const Axis y{roundTicks(y_range.low(), y_range.high(), 6), bottom, top + 44.0};
    canvas.text({70.0, top + 14.0}, chart.title, 15.0, Align::Left, kBlack);
    canvas.text({70.0, top + 34.0}, chart.y_label, 12.0, Align::Left, kGrey);
    for (const double tick : y.ticks) {
        canvas.line({{x.from, y.at(tick)}, {x.to, y.at(tick)}}, kPale, 1.0);
        canvas.text({x.from - 8.0, y.at(tick) + 4.0}, fmt::format("{:.4g}", tick), 12.0,
                    Align::Right, kBlack);
    }
    for (const double tick : x.ticks) {
        canvas.line({{x.at(tick), y.from}, {x.at(tick), y.from + 5.0}}, kGrey, 1.0);
        canvas.text({x.at(tick), y.from + 20.0}, fmt::format("{:.4g}", tick), 12.0, Align::Middle,
                    kBlack);
    }
    canvas.line({{x.from, y.from}, {x.to, y.from}}, kGrey, 1.0);
    canvas.text({0.5 * (x.from + x.to), y.from + 40.0}, chart.x_label, 12.0, Align::Middle, kGrey);
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        drawCurve(canvas, chart.curves[i], x, y, inkOf(i));
        const double row = y.to + 20.0 * static_cast<double>(i);
        canvas.line({{x.to + 16.0, row}, {x.to + 40.0, row}}, inkOf(i), 2.0);
        canvas.dot({x.to + 28.0, row}, 3.0, inkOf(i));
        canvas.text({x.to + 48.0, row + 4.0}, chart.curves[i].name, 12.0, Align::Left, kBlack);
    }
}

double barsHeight(const BarChart& chart) {
    return kBarHead + kBarHeight * static_cast<double>(chart.names.size());
}

void drawBars(Canvas& canvas, const BarChart& chart, const Vector2d& corner, double width) {
    Range range;
    range.add(0.0);
    for (const auto& value : chart.values) range.add(value.value_or(0.0));
    const double name_width = 130.0;
    const Axis x{roundTicks(0.0, range.high(), 4), corner.x() + name_width,
                 corner.x() + width - 70.0};
    canvas.text({corner.x() + name_width, corner.y() + 14.0}, chart.title, 14.0, Align::Left,
                kBlack);
    const double first = corner.y() + 24.0;
    for (std::size_t i = 0; i < chart.names.size(); ++i) {
        const double row = first + kBarHeight * static_cast<double>(i);
        const double middle = row + 0.5 * kBarHeight;
        canvas.text({x.from - 8.0, middle + 4.0}, chart.names[i], 12.0, Align::Right, kBlack);
        if (!chart.values[i] || !std::isfinite(*chart.values[i])) {
            canvas.text({x.from + 4.0, middle + 4.0}, "-", 12.0, Align::Left, kGrey);
            continue;
        }
        const double end = x.at(*chart.values[i]);
        canvas.rectangle({x.from, row + 3.0}, {std::max(end, x.from + 1.0), row + kBarHeight - 3.0},
                         inkOf(i == 0 ? 0 : 6));
        canvas.text({end + 6.0, middle + 4.0}, fmt::format("{:.3g}", *chart.values[i]), 12.0,
                    Align::Left, kBlack);
    }
}

std::string draw(const Figure& figure, std::unique_ptr<Canvas> (*make)(int, int)) {
    double height = kTitleHeight + kChartHeight * static_cast<double>(figure.charts.size());
    for (std::size_t i = 0; i < figure.bars.size(); i += kBarColumns) {
        height += barsHeight(figure.bars[i]);
    }
    const auto canvas = make(kWidth, static_cast<int>(height));
    canvas->rectangle({0, 0}, {kWidth, height}, {255, 255, 255});
    canvas->text({20.0, 28.0}, figure.title, 18.0, Align::Left, kBlack);
    double top = kTitleHeight;
    for (const Chart& chart : figure.charts) {
        drawChart(*canvas, chart, top);
        top += kChartHeight;
    }
    for (std::size_t i = 0; i < figure.bars.size(); ++i) {
        const double width = (kWidth - 30.0) / kBarColumns;
        const auto column = static_cast<double>(i % kBarColumns);
        drawBars(*canvas, figure.bars[i], {10.0 + column * width, top}, width);
        if (i % kBarColumns == kBarColumns - 1) top += barsHeight(figure.bars[i]);
    }
    return canvas->finish();
}

}  // namespace

std::vector<double> roundTicks(double low, double high, int count) {
    if (!(high > low)) high = low + (low == 0.0 ? 1.0 : std::abs(low));
    const double rough = (high - low) / std::max(1, count);
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= rough * (1.0 - 1e-9)) {
            step = factor * power;
            break;
        }
    }
    const auto first = static_cast<long long>(std::floor(low / step + 1e-9));
    const auto last = static_cast<long long>(std::ceil(high / step - 1e-9));
    std::vector<double> ticks;
    for (long long i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
    return ticks;
}

std::string figureSvg(const Figure& figure) {
    return draw(figure, makeSvgCanvas);
}

Status checkFigureName(const std::filesystem::path& path) {
    if (path.extension() == ".svg" || path.extension() == ".png") return {};
    return fail(ErrorCode::Usage, "The figure's file name must end in .svg or .png.",
                path.string());
}

Status writeFigure(const Figure& figure, const std::filesystem::path& path) {
    return checkFigureName(path).and_then([&]() -> Status {
        const std::string bytes =
            draw(figure, path.extension() == ".svg" ? makeSvgCanvas : makePngCanvas);
        if (bytes.empty()) {
            return fail(ErrorCode::Failed, "The figure cannot be encoded.", path.string());
        }
        return writeWhole(path, bytes);
    });
}

}  // namespace dollytrack::render
