#include "app/statistics/charts.h"
#include "app/statistics/page_text.h"
#include "app/statistics/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::statistics {
namespace {

constexpr std::size_t kNameBytes = 17;

/// A bar of a class and dataset.
struct ClassBar {
    double filled = 0.0;
    double outlined = 0.0;  // 0: no outline
};

using BarOf = ClassBar (*)(const ClassStatistics& counted);

std::string barText(const PlotFrame& frame, const ClassBar& bar, std::size_t dataset, double y,
                    double height) {
    std::string text;
    const double left = frame.left();
    if (bar.outlined > 0.0) {
        text += fmt::format(
            "<rect class=\"whole s{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
            "height=\"{:.1f}\"/>",
            dataset, left, y, frame.xAt(bar.outlined) - left, height);
    }
    if (bar.filled > 0.0) {
        text += fmt::format(
            "<rect class=\"bars s{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
            "height=\"{:.1f}\"/>",
            dataset, left, y, std::max(0.8, frame.xAt(bar.filled) - left), height);
    }
    const std::string value = bar.outlined > 0.0 ? fmt::format("{} of {}", numberText(bar.filled),
                                                               numberText(bar.outlined))
                                                 : numberText(bar.filled);
    text += fmt::format("<text class=\"value\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
                        frame.xAt(std::max(bar.filled, bar.outlined)) + 4.0, y + 0.5 * height + 3.5,
                        value);
    return text;
}

std::string classChart(std::span<const ClassRow> all, const std::string& title,
                       const std::string& label, BarOf bar_of) {
    const std::span<const ClassRow> rows = all.first(chartClassesOf(all));
    const std::size_t datasets = rows.empty() ? 0 : rows[0].datasets.size();
    double most = 1.0;
    bool has_outlines = false;
    for (const ClassRow& row : rows) {
        for (const ClassStatistics* counted : row.datasets) {
            if (counted == nullptr) continue;
            const ClassBar bar = bar_of(*counted);
            most = std::max({most, bar.filled, bar.outlined});
            has_outlines |= bar.outlined > 0.0;
        }
    }
    const double bar_height = datasets == 1 ? 12.0 : 10.0;
    const double row_height = static_cast<double>(datasets) * (bar_height + 1.0) + 6.0;
    // With space for the number behind the bar, or for two, as in "322 of 362".
    PlotAxis x{0.0, (has_outlines ? 1.45 : 1.22) * most, false, {}, label};
    x.ticks = linearTicks(0.0, most, 1.0, 4);
    std::erase_if(x.ticks, [](const PlotTick& tick) { return tick.at != std::round(tick.at); });
    const PlotFrame frame(x, {}, row_height * static_cast<double>(rows.size()), 116.0);
    std::string content;
    double y = frame.top() + 3.0;
    for (const ClassRow& row : rows) {
        content +=
            fmt::format("<text class=\"y\" x=\"110\" y=\"{:.1f}\">{}<title>{}</title></text>",
                        y + 0.5 * (row_height - 6.0) + 3.5, shownName(row.name, kNameBytes),
                        shownName(row.name));
        for (std::size_t i = 0; i < datasets; ++i) {
            const ClassBar bar = row.datasets[i] != nullptr ? bar_of(*row.datasets[i]) : ClassBar();
            content +=
                barText(frame, bar, i, y + static_cast<double>(i) * (bar_height + 1.0), bar_height);
        }
        y += row_height;
    }
    return frame.svg(title, content);
}

}  // namespace

std::size_t chartClassesOf(std::span<const ClassRow> rows) {
    constexpr std::size_t kMostClasses = 15;
    constexpr std::size_t kMostBars = 36;
    if (rows.empty()) return 0;
    return std::min({rows.size(), kMostClasses, kMostBars / rows[0].datasets.size()});
}

std::string boxesByClassChart(std::span<const ClassRow> rows) {
    return classChart(rows, "Boxes by class", "boxes", [](const ClassStatistics& counted) {
        return ClassBar{static_cast<double>(counted.boxes), 0.0};
    });
}

std::string capturedByClassChart(std::span<const ClassRow> rows) {
    return classChart(rows, "Captured objects by class", "objects",
                      [](const ClassStatistics& counted) {
                          return ClassBar{static_cast<double>(counted.captured),
                                          static_cast<double>(counted.targets)};
                      });
}

}  // namespace dollytrack::statistics
