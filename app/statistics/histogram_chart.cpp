#include "app/statistics/charts.h"
#include "app/statistics/page_text.h"
#include "app/statistics/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::statistics {
namespace {

constexpr double kPlotHeight = 150.0;

double shareOf(const Histogram& histogram, std::size_t bin) {
    if (histogram.total == 0) return 0.0;
    return static_cast<double>(histogram.counts[bin]) / static_cast<double>(histogram.total);
}

PlotAxis valueAxis(const QuantityInfo& info, const Bins& bins) {
    PlotAxis axis{bins.edges.front(), bins.edges.back(), bins.logarithmic, {}, info.axis};
    if (bins.logarithmic) {
        axis.ticks = powerTicks(axis.low, axis.high, info.factor,
                                info.kind == AxisKind::Octaves ? 2.0 : 10.0);
        axis.label += " (log scale)";
    } else {
        axis.ticks = linearTicks(axis.low, axis.high, info.factor, 6);
        if (info.kind == AxisKind::Count) {
            std::erase_if(axis.ticks,
                          [](const PlotTick& tick) { return tick.at != std::round(tick.at); });
        }
    }
    return axis;
}

/// An outline with a pale area below it.
std::string outline(const PlotFrame& frame, const Bins& bins, const Histogram& histogram,
                    std::size_t dataset) {
    std::string steps = fmt::format("{:.1f} {:.1f}", frame.xAt(bins.edges[0]), frame.bottom());
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        steps += fmt::format("V{:.1f}H{:.1f}", frame.yAt(shareOf(histogram, i)),
                             frame.xAt(bins.edges[i + 1]));
    }
    return fmt::format(
        "<path class=\"area s{}\" d=\"M{}V{:.1f}z\"/><path class=\"line s{}\" "
        "d=\"M{}V{:.1f}\"/>",
        dataset, steps, frame.bottom(), dataset, steps, frame.bottom());
}

/// Invisible columns that show the numbers of a bin under the pointer.
std::string tooltips(const PlotFrame& frame, const QuantityInfo& info, const Bins& bins,
                     std::span<const Histogram> histograms,
                     std::span<const DatasetStatistics> datasets) {
    std::string text;
    for (std::size_t i = 0; i + 1 < bins.edges.size(); ++i) {
        std::string label = fmt::format("{} to {}{}", numberText(bins.edges[i] * info.factor),
                                        numberText(bins.edges[i + 1] * info.factor), info.unit);
        if (info.kind == AxisKind::Count) {
            const double low = std::ceil(bins.edges[i]);
            const double high = std::floor(bins.edges[i + 1]);
            label = low == high ? numberText(low)
                                : fmt::format("{} to {}", numberText(low), numberText(high));
        }
        for (std::size_t d = 0; d < datasets.size(); ++d) {
            label +=
                fmt::format("\n{}: {} ({} %)",
                            datasets.size() == 1 ? info.items : shownName(datasets[d].name, 12),
                            numberText(static_cast<double>(histograms[d].counts[i])),
                            numberText(100.0 * shareOf(histograms[d], i)));
        }
        const double left = frame.xAt(bins.edges[i]);
        text += fmt::format(
            "<rect class=\"bin\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">"
            "<title>{}</title></rect>",
            left, frame.top(), frame.xAt(bins.edges[i + 1]) - left, kPlotHeight, label);
    }
    return text;
}

}  // namespace

std::string histogramChart(const QuantityInfo& info, const Bins& bins,
                           std::span<const DatasetStatistics> datasets) {
    std::vector<Histogram> histograms;
    double most = 0.0;
    for (const DatasetStatistics& dataset : datasets) {
        histograms.push_back(histogramOf(bins, dataset.valuesOf(info.quantity)));
        for (std::size_t i = 0; i < histograms.back().counts.size(); ++i) {
            most = std::max(most, shareOf(histograms.back(), i));
        }
    }
    PlotAxis y{0.0, std::max(1e-6, 1.06 * most), false, {}, fmt::format("% of {}", info.items)};
    y.ticks = linearTicks(y.low, y.high, 100.0, 5);
    const PlotFrame frame(valueAxis(info, bins), y, kPlotHeight);
    std::string content;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        if (histograms[i].total == 0) continue;
        content += outline(frame, bins, histograms[i], i);
    }
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        const std::optional<Spread> spread = spreadOf(datasets[i].valuesOf(info.quantity));
        if (!spread) continue;
        content += fmt::format("<path class=\"median s{}\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", i,
                               frame.xAt(spread->median), frame.bottom(), frame.top());
    }
    content += tooltips(frame, info, bins, histograms, datasets);
    return frame.svg(info.title, content);
}

}  // namespace dollytrack::statistics
