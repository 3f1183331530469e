#include "app/statistics/charts.h"
#include "app/statistics/plot_frame.h"
#include "app/statistics/trajectory_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::statistics {
namespace {

/// `scale` is the number of the axis per second.
std::string polyline(const PlotFrame& frame, const TrajectoryLine& line, double begin_s,
                     double scale) {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < line.values.size(); ++i) {
        if (line.values[i]) {
            path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M",
                                frame.xAt((line.time_s[i] - begin_s) * scale),
                                frame.yAt(*line.values[i]));
        }
        drawing = line.values[i].has_value();
    }
    return path;
}

}  // namespace

std::string lineChart(std::size_t line, std::span<const DatasetStatistics> datasets) {
    const QuantityInfo& info = infoOf(kAlongTrajectory[line]);
    double low = info.kind == AxisKind::FromZero ? 0.0 : 1e9;
    double high = -1e9;
    std::vector<TrajectoryLine> lines;
    for (const DatasetStatistics& one : datasets) {
        lines.push_back(trajectoryLineOf(one.time_s, one.along[line]));
        for (const std::optional<double>& value : lines.back().values) {
            if (!value) continue;
            low = std::min(low, *value);
            high = std::max(high, *value);
        }
    }
    const double margin = std::max(0.06 * (high - low), 1e-3);
    // Trajectories of different durations are compared by their progress.
    const bool single = datasets.size() == 1;
    PlotAxis x{0.0, 100.0, false, {}, "part of the trajectory's duration, %"};
    if (single) {
        x.high = std::max(datasets[0].duration_s, 1e-3);
        x.label = "time since the first frame, s";
    }
    x.ticks = linearTicks(x.low, x.high, 1.0, 6);
    PlotAxis y{low == 0.0 ? 0.0 : low - margin, high + margin, false, {}, info.axis};
    y.ticks = linearTicks(y.low, y.high, 1.0, 4);
    const PlotFrame frame(x, y, 120.0);
    std::string content;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        const double scale = single ? 1.0 : 100.0 / std::max(datasets[i].duration_s, 1e-3);
        content += fmt::format("<path class=\"line s{}\" d=\"{}\"/>", i,
                               polyline(frame, lines[i], datasets[i].time_s.front(), scale));
    }
    return frame.svg(fmt::format("{} along the trajectory", info.title), content);
}

}  // namespace dollytrack::statistics
