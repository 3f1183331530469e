#include "app/statistics/statistics_page.h"

#include "app/statistics/histogram.h"
#include "app/statistics/overview.h"

namespace dollytrack::statistics {
namespace {

using nlohmann::json;

json classesJson(const DatasetStatistics& dataset) {
    json list = json::array();
    for (const ClassStatistics& row : dataset.classes) {
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
    json histogram_json = {
        {"values", histogram.total}, {"counts", histogram.counts}, {"beyond", histogram.beyond}};
    if (const std::optional<Spread> spread = spreadOf(values)) {
        histogram_json["p10"] = spread->p10;
        histogram_json["median"] = spread->median;
        histogram_json["p90"] = spread->p90;
    }
    return histogram_json;
}

}  // namespace

json statisticsJson(std::span<const DatasetStatistics> datasets) {
    const SharedBins bins = sharedBinsOf(datasets);
    json edges = json::object();
    for (const QuantityInfo& info : quantities()) {
        const auto& shared = bins[static_cast<std::size_t>(info.quantity)];
        if (shared) edges[info.key] = shared->edges;
    }
    json list = json::array();
    for (const DatasetStatistics& dataset : datasets) {
        json numbers = json::object();
        for (const OverviewRow& row : overview()) {
            const std::optional<double> value = row.value(dataset);
            numbers[row.key] = value ? json(*value) : json();
        }
        json histograms = json::object();
        for (const QuantityInfo& info : quantities()) {
            const auto& shared = bins[static_cast<std::size_t>(info.quantity)];
            if (shared)
                histograms[info.key] = histogramJson(*shared, dataset.valuesOf(info.quantity));
        }
        list.push_back({{"name", dataset.name},
                        {"datasets", dataset.datasets},
                        {"scene", dataset.scene},
                        {"overview", std::move(numbers)},
                        {"classes", classesJson(dataset)},
                        {"histograms", std::move(histograms)},
                        {"box_center_heat_map", heatMapJson(dataset.heat_map)},
                        {"image_frames_read", dataset.image_frames},
                        {"images_unreadable", dataset.images_unreadable}});
    }
    return {{"bin_edges", std::move(edges)}, {"datasets", std::move(list)}};
}

}  // namespace dollytrack::statistics
