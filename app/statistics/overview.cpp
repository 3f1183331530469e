#include "app/statistics/overview.h"

#include "app/statistics/histogram.h"

#include <algorithm>
#include <functional>
#include <map>

namespace dollytrack::statistics {
namespace {

using Dataset = const DatasetStatistics&;
using Value = std::optional<double>;

std::size_t sumOf(Dataset dataset, std::size_t ClassStatistics::*field) {
    std::size_t sum = 0;
    for (const ClassStatistics& row : dataset.classes) sum += row.*field;
    return sum;
}

Value ratio(std::size_t part, std::size_t whole) {
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

Value pictureRatio(Dataset dataset, const std::vector<int>& frames) {
    return ratio(frames.size(), static_cast<std::size_t>(std::max(0, dataset.pictures.pictures)));
}

Value ofBoxes(Dataset dataset, std::size_t count) {
    if (!dataset.has_boxes) return std::nullopt;
    return static_cast<double>(count);
}

Value median(Dataset dataset, Quantity quantity) {
    const std::optional<Spread> spread = spreadOf(dataset.valuesOf(quantity));
    if (!spread) return std::nullopt;
    return spread->median;
}

const OverviewRow kRows[] = {
    {"frames", "frames", 1.0, [](Dataset dataset) -> Value { return dataset.frames; }},
    {"width_px", "image width, px", 1.0, [](Dataset dataset) -> Value { return dataset.width_px; }},
    {"height_px", "image height, px", 1.0,
     [](Dataset dataset) -> Value { return dataset.height_px; }},
    {"duration_s", "duration, s", 1.0, [](Dataset dataset) -> Value { return dataset.duration_s; }},
    {"path_length_m", "length of the path, m", 1.0,
     [](Dataset dataset) { return dataset.path_length_m; }},
    {"targets", "target objects", 1.0,
     [](Dataset dataset) -> Value { return sumOf(dataset, &ClassStatistics::targets); }},
    {"captured", "captured objects", 1.0,
     [](Dataset dataset) -> Value { return sumOf(dataset, &ClassStatistics::captured); }},
    {"capture_rate", "captured, % of the objects", 100.0,
     [](Dataset dataset) {
         return ratio(sumOf(dataset, &ClassStatistics::captured),
                      sumOf(dataset, &ClassStatistics::targets));
     }},
    {"well_captured_rate", "well captured, % of the objects", 100.0,
     [](Dataset dataset) {
         return ratio(sumOf(dataset, &ClassStatistics::well_captured),
                      sumOf(dataset, &ClassStatistics::targets));
     }},
    {"classes", "classes with boxes", 1.0,
     [](Dataset dataset) {
         return ofBoxes(dataset,
                        static_cast<std::size_t>(std::ranges::count_if(
                            dataset.classes, [](const auto& row) { return row.boxes > 0; })));
     }},
    {"boxes", "boxes", 1.0, [](Dataset dataset) { return ofBoxes(dataset, dataset.boxes); }},
    {"boxes_per_frame", "boxes per frame, mean", 1.0,
     [](Dataset dataset) {
         return dataset.has_boxes ? ratio(dataset.boxes, dataset.frames) : Value();
     }},
    {"boxes_at_border_rate", "boxes that touch the image border, %", 100.0,
     [](Dataset dataset) { return ratio(dataset.boxes_at_border, dataset.boxes); }},
    {"box_share_median", "box area, median, % of the image", 100.0,
     [](Dataset dataset) { return median(dataset, Quantity::BoxShare); }},
    {"distance_median_m", "distance to objects, median, m", 1.0,
     [](Dataset dataset) { return median(dataset, Quantity::Distance); }},
    {"speed_median_mps", "camera speed, median, m/s", 1.0,
     [](Dataset dataset) { return median(dataset, Quantity::Speed); }},
    {"turn_median_dps", "camera turn rate, median, °/s", 1.0,
     [](Dataset dataset) { return median(dataset, Quantity::TurnRate); }},
    {"luma_median", "brightness, median, 0 to 255", 1.0,
     [](Dataset dataset) { return median(dataset, Quantity::Luma); }},
    {"dark_rate", "dark images, %", 100.0,
     [](Dataset dataset) { return pictureRatio(dataset, dataset.pictures.dark); }},
    {"white_rate", "white images, %", 100.0,
     [](Dataset dataset) { return pictureRatio(dataset, dataset.pictures.white); }},
    {"flat_rate", "flat images, %", 100.0,
     [](Dataset dataset) { return pictureRatio(dataset, dataset.pictures.flat); }},
};

}  // namespace

std::span<const OverviewRow> overview() {
    return kRows;
}

std::size_t ClassRow::sum(std::size_t ClassStatistics::*number) const {
    std::size_t sum = 0;
    for (const ClassStatistics* counted : datasets) {
        if (counted != nullptr) sum += counted->*number;
    }
    return sum;
}

std::vector<ClassRow> classRowsOf(std::span<const DatasetStatistics> datasets,
                                  std::size_t ClassStatistics::*number) {
    std::map<std::string, ClassRow> by_name;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        for (const ClassStatistics& counted : datasets[i].classes) {
            ClassRow& row = by_name[counted.name];
            row.name = counted.name;
            row.datasets.resize(datasets.size());
            row.datasets[i] = &counted;
        }
    }
    std::vector<ClassRow> rows;
    for (auto& [name, row] : by_name) rows.push_back(std::move(row));
    std::ranges::stable_sort(rows, std::greater(),
                             [&](const ClassRow& row) { return row.sum(number); });
    return rows;
}

}  // namespace dollytrack::statistics
