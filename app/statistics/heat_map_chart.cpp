#include "app/statistics/charts.h"
#include "app/statistics/plot_frame.h"
#include "engine/math/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace dollytrack::statistics {
namespace {

constexpr int kLevels = 12;  // shades of the colour; cells of one shade are one path

double boxesIn(const HeatMap& map) {
    return static_cast<double>(
        std::accumulate(map.boxes.begin(), map.boxes.end(), std::uint64_t{0}));
}

double opacityOf(int level) {
    return 0.08 + 0.92 * level / kLevels;
}

/// The scale of the shades, below the image.
std::string legend(const PlotFrame& frame, std::size_t dataset, double full_share) {
    std::string text;
    const double width = 9.0;
    const double left = frame.right() - width * kLevels - 52.0;
    for (int level = 1; level <= kLevels; ++level) {
        text += fmt::format(
            "<rect class=\"bars s{}\" fill-opacity=\"{:.2f}\" x=\"{:.1f}\" y=\"5\" "
            "width=\"{:.1f}\" height=\"8\"/>",
            dataset, opacityOf(level), left + width * (level - 1), width);
    }
    text += fmt::format("<text class=\"y\" x=\"{:.1f}\" y=\"12\">% of boxes in a cell: 0</text>",
                        left - 4.0);
    text += fmt::format("<text class=\"value\" x=\"{:.1f}\" y=\"12\">\u2265 {}</text>",
                        left + width * kLevels + 4.0, numberText(100.0 * full_share));
    return text;
}

}  // namespace

double fullShareOf(const HeatMap& map) {
    std::vector<double> shares;
    for (const std::uint64_t boxes : map.boxes) {
        if (boxes > 0) shares.push_back(static_cast<double>(boxes) / boxesIn(map));
    }
    if (shares.empty()) return 0.0;
    std::sort(shares.begin(), shares.end());
    return quantile(shares, 0.98);
}

std::string heatMapChart(const DatasetStatistics& statistics, std::size_t dataset,
                         double full_share) {
    const HeatMap& map = statistics.heat_map;
    const PlotAxis x{0.0,
                     static_cast<double>(statistics.width_px),
                     false,
                     {{0.0, "0"},
                      {0.5 * statistics.width_px, numberText(0.5 * statistics.width_px)},
                      {static_cast<double>(statistics.width_px), numberText(statistics.width_px)}},
                     "image column, px"};
    PlotAxis y{0.0, static_cast<double>(statistics.height_px), false, {}, "row, px"};
    y.ticks = {{0.0, numberText(statistics.height_px)},  // rows count downwards
               {0.5 * statistics.height_px, numberText(0.5 * statistics.height_px)},
               {static_cast<double>(statistics.height_px), "0"}};
    const double cell = (PlotFrame::kWidth - 12.0 - 40.0) / map.columns;
    const PlotFrame frame(x, y, cell * map.rows);
    std::array<std::string, kLevels + 1> paths;
    const double boxes = boxesIn(map);
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            const std::size_t i = static_cast<std::size_t>(row) * map.columns + column;
            if (map.boxes[i] == 0) continue;
            const double share = static_cast<double>(map.boxes[i]) / boxes / full_share;
            const int level = std::clamp(static_cast<int>(std::ceil(share * kLevels)), 1, kLevels);
            paths[level] +=
                fmt::format("M{:.2f} {:.2f}h{:.2f}v{:.2f}h-{:.2f}z", frame.left() + cell * column,
                            frame.top() + cell * row, cell, cell, cell);
        }
    }
    std::string content;
    for (int level = 1; level <= kLevels; ++level) {
        if (paths[level].empty()) continue;
        content += fmt::format("<path class=\"bars s{}\" fill-opacity=\"{:.2f}\" d=\"{}\"/>",
                               dataset, opacityOf(level), paths[level]);
    }
    content += legend(frame, dataset, full_share);
    return frame.svg("Box centres over the image", content);
}

}  // namespace dollytrack::statistics
