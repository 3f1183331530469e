#include "app/statistics/histogram.h"

#include "engine/math/quantile.h"
#include "render/plots/figure.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::statistics {
namespace {

constexpr int kLinearBins = 40;      // at most about
constexpr double kLeastHigh = 1e-3;  // of axes from zero
// Of other axes, as a share of the values: numbers of three digits at the axis differ.
constexpr double kLeastRange = 0.05;

struct Range {
    double low = 0.0;
    double high = 0.0;
};

/// `per_power` bins per factor of `base`, from one whole power to another.
std::vector<double> powerEdges(double base, int per_power, Range range) {
    const auto power = [base](double value) { return std::log(value) / std::log(base); };
    const int first = static_cast<int>(std::floor(power(range.low) + 1e-9));
    const int last = std::max(first + 1, static_cast<int>(std::ceil(power(range.high) - 1e-9)));
    std::vector<double> edges;
    for (int i = 0; i <= (last - first) * per_power; ++i) {
        edges.push_back(std::pow(base, first + static_cast<double>(i) / per_power));
    }
    // Powers are rounded.
    edges.front() = std::min(edges.front(), range.low);
    edges.back() = std::max(edges.back(), range.high);
    return edges;
}

std::vector<double> evenEdges(double low, double high, int count) {
    std::vector<double> edges;
    for (int i = 0; i <= count; ++i) edges.push_back(low + (high - low) * i / count);
    return edges;
}

std::vector<double> roundEdges(double low, double high) {
    std::vector<double> edges = render::roundTicks(low, high, kLinearBins);
    edges.front() = std::min(edges.front(), low);
    edges.back() = std::max(edges.back(), high);
    return edges;
}

/// Each bin is centred on a whole number, or holds several of them.
std::vector<double> countEdges(double most) {
    const double step = std::max(1.0, std::ceil((most + 1.0) / 40.0));
    std::vector<double> edges = {-0.5};
    while (edges.back() < most) edges.push_back(edges.back() + step);
    return edges;
}

/// The largest value, or a quantile of the values if the largest is far beyond it.
double usualHigh(std::span<const std::vector<double>* const> samples) {
    double most = 0.0;
    double usual = 0.0;
    for (const std::vector<double>* values : samples) {
        if (values->empty()) continue;
        std::vector<double> sorted = *values;
        std::sort(sorted.begin(), sorted.end());
        most = std::max(most, sorted.back());
        usual = std::max(usual, quantile(sorted, 0.995));
    }
    return most > 1.5 * usual && usual > 0.0 ? usual : most;
}

std::vector<double> edgesFor(AxisKind kind, Range range,
                             std::span<const std::vector<double>* const> samples) {
    switch (kind) {
        case AxisKind::Decades:
            return powerEdges(10.0, 5, range);
        case AxisKind::Octaves:
            return powerEdges(2.0, 4, range);
        case AxisKind::Share:
            return evenEdges(0.0, 1.0, 20);
        case AxisKind::Byte:
            return evenEdges(0.0, 256.0, 32);
        case AxisKind::Count:
            return countEdges(range.high);
        case AxisKind::FromZero: {
            const double high = usualHigh(samples);
            return roundEdges(0.0, high < kLeastHigh ? 1.0 : high);
        }
        case AxisKind::Linear:
            break;
    }
    // Equal values may differ by rounding.
    const double middle = 0.5 * (range.low + range.high);
    const double least = kLeastRange * std::max(1.0, std::abs(middle));
    if (range.high - range.low < least) range = {middle - 0.5 * least, middle + 0.5 * least};
    return roundEdges(range.low, range.high);
}

/// Values on logarithmic axes must be positive.
std::optional<Bins> binsFor(AxisKind kind, std::span<const std::vector<double>* const> samples) {
    std::optional<Range> range;
    for (const std::vector<double>* values : samples) {
        for (const double value : *values) {
            if (!range) range = Range{value, value};
            range->low = std::min(range->low, value);
            range->high = std::max(range->high, value);
        }
    }
    if (!range) return std::nullopt;
    return Bins{edgesFor(kind, *range, samples),
                kind == AxisKind::Decades || kind == AxisKind::Octaves};
}

}  // namespace

SharedBins sharedBinsOf(std::span<const DatasetStatistics> datasets) {
    SharedBins bins;
    for (const QuantityInfo& info : quantities()) {
        std::vector<const std::vector<double>*> samples;
        for (const DatasetStatistics& dataset : datasets) {
            samples.push_back(&dataset.valuesOf(info.quantity));
        }
        bins[static_cast<std::size_t>(info.quantity)] = binsFor(info.kind, samples);
    }
    return bins;
}

Histogram histogramOf(const Bins& bins, const std::vector<double>& values) {
    Histogram histogram{std::vector<std::uint64_t>(bins.edges.size() - 1), 0, values.size()};
    for (const double value : values) {
        const auto above = std::upper_bound(bins.edges.begin(), bins.edges.end(), value);
        std::ptrdiff_t bin = above - bins.edges.begin() - 1;
        if (value == bins.edges.back()) --bin;
        if (bin < 0 || bin >= static_cast<std::ptrdiff_t>(histogram.counts.size())) {
            ++histogram.beyond;
        } else {
            ++histogram.counts[static_cast<std::size_t>(bin)];
        }
    }
    return histogram;
}

std::optional<Spread> spreadOf(std::vector<double> values) {
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    return Spread{quantile(values, 0.1), quantile(values, 0.5), quantile(values, 0.9)};
}

}  // namespace dollytrack::statistics
