#include "app/statistics/statistics_json.h"

#include "app/statistics/histogram.h"
#include "app/statistics/overview.h"
#include "app/statistics/trajectory_line.h"

namespace dollytrack::statistics {
namespace {

using nlohmann::json;

json optionalJson(const std::optional<double>& value) {
    return value ? json(*value) : json();
}

json classesJson(const DatasetStatistics& one) {
    json list = json::array();
    for (const ClassStatistics& row : one.classes) {
        list.push_back({{"id", row.id},
                        {"name", row.name},
                        {"boxes", row.boxes},
                        {"frames", row.frames},
                        {"objects", row.objects},
                        {"targets", row.targets},
                        {"captured", row.captured},
                        {"well_captured", row.well_captured}});
    }
    return list;
}

json heatMapJson(const HeatMap& map) {
    json rows = json::array();
    for (int y = 0; y < map.rows; ++y) {
        const auto begin = map.boxes.begin() + static_cast<std::ptrdiff_t>(y) * map.columns;
        rows.push_back(std::vector<std::uint64_t>(begin, begin + map.columns));
    }
    return rows;
}

json histogramJson(const Bins& bins, const std::vector<double>& values) {
    const Histogram histogram = histogramOf(bins, values);
    json one = {
        {"values", histogram.total}, {"counts", histogram.counts}, {"beyond", histogram.beyond}};
    if (const std::optional<Spread> spread = spreadOf(values)) {
        one["p10"] = spread->p10;
        one["median"] = spread->median;
        one["p90"] = spread->p90;
    }
    return one;
}

json alongJson(const DatasetStatistics& one) {
    json lines = json::object();
    for (std::size_t i = 0; i < kAlongTrajectory.size(); ++i) {
        const TrajectoryLine line = trajectoryLineOf(one.time_s, one.along[i]);
        json values = json::array();
        for (const std::optional<double>& value : line.values)
            values.push_back(optionalJson(value));
        lines["time_s"] = line.time_s;
        lines[infoOf(kAlongTrajectory[i]).key] = std::move(values);
    }
    return lines;
}

}  // namespace

json statisticsJson(std::span<const DatasetStatistics> datasets) {
    const SharedBins bins = sharedBinsOf(datasets);
    const std::vector<OverviewRow> overview = overviewOf(datasets);
    json edges = json::object();
    for (const QuantityInfo& info : quantities()) {
        const auto& shared = bins[static_cast<std::size_t>(info.quantity)];
        if (shared) edges[info.key] = shared->edges;
    }
    json list = json::array();
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        const DatasetStatistics& one = datasets[i];
        json numbers = json::object();
        for (const OverviewRow& row : overview) numbers[row.key] = optionalJson(row.values[i]);
        json histograms = json::object();
        for (const QuantityInfo& info : quantities()) {
            const auto& shared = bins[static_cast<std::size_t>(info.quantity)];
            if (shared) histograms[info.key] = histogramJson(*shared, one.of(info.quantity));
        }
        list.push_back({{"name", one.name},
                        {"scene", one.scene},
                        {"overview", std::move(numbers)},
                        {"classes", classesJson(one)},
                        {"histograms", std::move(histograms)},
                        {"box_center_heat_map", heatMapJson(one.heat_map)},
                        {"along_trajectory", alongJson(one)},
                        {"image_frames_read", one.images.frames},
                        {"images_unreadable", one.images.unreadable}});
    }
    return {{"bin_edges", std::move(edges)}, {"datasets", std::move(list)}};
}

}  // namespace dollytrack::statistics
