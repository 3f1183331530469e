#include "app/statistics/overview.h"

#include "app/statistics/histogram.h"

#include <algorithm>
#include <map>

namespace dollytrack::statistics {
namespace {

using Value = std::optional<double>;

std::size_t sumOf(const DatasetStatistics& one, std::size_t ClassStatistics::*field) {
    std::size_t sum = 0;
    for (const ClassStatistics& row : one.classes) sum += row.*field;
    return sum;
}

Value ratio(std::size_t part, std::size_t whole) {
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

Value ofBoxes(const DatasetStatistics& one, std::size_t count) {
    if (!one.has_boxes) return std::nullopt;
    return static_cast<double>(count);
}

Value median(const DatasetStatistics& one, Quantity quantity) {
    const std::optional<Spread> spread = spreadOf(one.of(quantity));
    if (!spread) return std::nullopt;
    return spread->median;
}

struct RowKind {
    const char* key;
    const char* label;
    double factor;
    Value (*value)(const DatasetStatistics& one);
};

using D = DatasetStatistics;

const RowKind kRows[] = {
    {"frames", "frames", 1.0, [](const D& d) -> Value { return d.frames; }},
    {"width_px", "image width, px", 1.0, [](const D& d) -> Value { return d.width_px; }},
    {"height_px", "image height, px", 1.0, [](const D& d) -> Value { return d.height_px; }},
    {"duration_s", "duration, s", 1.0, [](const D& d) -> Value { return d.duration_s; }},
    {"path_length_m", "length of the path, m", 1.0, [](const D& d) { return d.path_length_m; }},
    {"targets", "target objects", 1.0,
     [](const D& d) -> Value { return sumOf(d, &ClassStatistics::targets); }},
    {"captured", "captured objects", 1.0,
     [](const D& d) -> Value { return sumOf(d, &ClassStatistics::captured); }},
    {"capture_rate", "captured, % of the objects", 100.0,
     [](const D& d) {
         return ratio(sumOf(d, &ClassStatistics::captured), sumOf(d, &ClassStatistics::targets));
     }},
    {"well_captured_rate", "well captured, % of the objects", 100.0,
     [](const D& d) {
         return ratio(sumOf(d, &ClassStatistics::well_captured),
                      sumOf(d, &ClassStatistics::targets));
     }},
    {"classes", "classes with boxes", 1.0,
     [](const D& d) {
         return ofBoxes(d, static_cast<std::size_t>(std::ranges::count_if(
                               d.classes, [](const auto& row) { return row.boxes > 0; })));
     }},
    {"boxes", "boxes", 1.0, [](const D& d) { return ofBoxes(d, d.boxes); }},
    {"boxes_per_frame", "boxes per frame, mean", 1.0,
     [](const D& d) { return d.has_boxes ? ratio(d.boxes, d.frames) : Value(); }},
    {"boxes_at_border_rate", "boxes that touch the image border, %", 100.0,
     [](const D& d) { return ratio(d.boxes_at_border, d.boxes); }},
    {"box_share_median", "box area, median, % of the image", 100.0,
     [](const D& d) { return median(d, Quantity::BoxShare); }},
    {"distance_median_m", "distance to objects, median, m", 1.0,
     [](const D& d) { return median(d, Quantity::Distance); }},
    {"speed_median_mps", "camera speed, median, m/s", 1.0,
     [](const D& d) { return median(d, Quantity::Speed); }},
    {"turn_median_dps", "camera turn rate, median, °/s", 1.0,
     [](const D& d) { return median(d, Quantity::TurnRate); }},
    {"luma_median", "brightness, median, 0 to 255", 1.0,
     [](const D& d) { return median(d, Quantity::Luma); }},
    {"dark_rate", "dark images, %", 100.0,
     [](const D& d) { return ratio(d.unusable.dark, d.unusable.measured); }},
    {"white_rate", "white images, %", 100.0,
     [](const D& d) { return ratio(d.unusable.white, d.unusable.measured); }},
    {"flat_rate", "flat images, %", 100.0,
     [](const D& d) { return ratio(d.unusable.flat, d.unusable.measured); }},
};

}  // namespace

std::vector<OverviewRow> overviewOf(std::span<const DatasetStatistics> datasets) {
    std::vector<OverviewRow> rows;
    for (const RowKind& kind : kRows) {
        OverviewRow row{kind.key, kind.label, kind.factor, {}};
        for (const DatasetStatistics& one : datasets) row.values.push_back(kind.value(one));
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<ClassRow> classRowsOf(std::span<const DatasetStatistics> datasets) {
    std::map<std::string, ClassRow> by_name;
    for (std::size_t i = 0; i < datasets.size(); ++i) {
        for (const ClassStatistics& one : datasets[i].classes) {
            ClassRow& row = by_name[one.name];
            row.name = one.name;
            row.datasets.resize(datasets.size());
            row.datasets[i] = &one;
        }
    }
    std::vector<ClassRow> rows;
    for (auto& [name, row] : by_name) rows.push_back(std::move(row));
    const auto boxes = [](const ClassRow& row) {
        std::size_t sum = 0;
        for (const ClassStatistics* one : row.datasets) sum += one != nullptr ? one->boxes : 0;
        return sum;
    };
    std::ranges::stable_sort(rows, std::greater(), boxes);
    return rows;
}

}  // namespace dollytrack::statistics
