#include "app/statistics/dataset_statistics.h"

#include "app/cli/terminal/output_file.h"
#include "app/statistics/dataset_measurements.h"
#include "app/view/even_frames.h"
#include "render/formats/tables/dataset_card.h"
#include "render/verify/read/number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::statistics {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloorClass = 2;  // NYU40
// Beyond this a file is damaged; axes could not be drawn.
constexpr double kLargest = 1e6;
constexpr double kLongest_s = 1e9;

tl::unexpected<Error> damagedTable(const std::filesystem::path& path, std::size_t row,
                                   const char* column) {
    return fail(ErrorCode::BadInput,
                fmt::format("The value of {} is missing or out of range; export the dataset again.",
                            column),
                fmt::format("{}:{}", path.string(), row + 2));
}

/// Visible fractions and truncations, from instances.csv.
Status addVisibility(const verify::StoredDataset& dataset, DatasetStatistics& statistics) {
    if (!dataset.has("instances")) return {};
    const std::filesystem::path path = dataset.folder / "instances.csv";
    const auto table = verify::NumberTable::read(path);
    if (!table) return tl::unexpected(table.error());
    for (std::size_t i = 0; i < table->rows(); ++i) {
        for (const Quantity quantity : {Quantity::VisibleFraction, Quantity::Truncation}) {
            const char* column = infoOf(quantity).key;
            const std::optional<double> value = table->number(i, column);
            if (!value || *value < 0.0 || *value > 1.0) return damagedTable(path, i, column);
            statistics.valuesOf(quantity).push_back(*value);
        }
    }
    return {};
}

/// Height above the highest floor below the camera; without one, above z = 0.
double heightOf(const Eigen::Vector3d& position, const std::vector<OrientedBox>& floors) {
    double floor_z = 0.0;
    bool found = false;
    for (const OrientedBox& box : floors) {
        const Eigen::Vector3d in_box = box.toBox(position);
        const double top = box.center.z() + box.half_size.z();
        const bool above = top <= position.z() && std::abs(in_box.x()) <= box.half_size.x() &&
                           std::abs(in_box.y()) <= box.half_size.y();
        if (!above || (found && top <= floor_z)) continue;
        floor_z = top;
        found = true;
    }
    return position.z() - floor_z;
}

Status addPoses(const verify::StoredDataset& dataset, DatasetStatistics& statistics) {
    std::vector<OrientedBox> floors;
    for (const verify::StoredObject& object : dataset.objects) {
        if (object.nyu40 == kFloorClass) floors.push_back(object.box);
    }
    for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
        const verify::StoredFrame& frame = dataset.frames[i];
        if (!(std::abs(frame.time_s) <= kLongest_s)) {
            return fail(
                ErrorCode::BadInput,
                "The time is beyond 1,000,000,000 s; export the dataset again.",
                fmt::format("{}: frames[{}]", (dataset.folder / "dataset.json").string(), i));
        }
        const double sine = std::clamp(frame.pose.forward().z(), -1.0, 1.0);
        statistics.valuesOf(Quantity::CameraHeight)
            .push_back(heightOf(frame.pose.position, floors));
        statistics.valuesOf(Quantity::CameraPitch)
            .push_back(std::asin(sine) * 180.0 / std::numbers::pi);
    }
    statistics.duration_s = dataset.frames.back().time_s - dataset.frames.front().time_s;
    return {};
}

/// Speeds, turn rates and length of the path, from frames.csv. Both rates are missing where a path
/// begins.
Status addMotion(const verify::StoredDataset& dataset, DatasetStatistics& statistics) {
    const std::size_t frames = dataset.frames.size();
    if (!dataset.has("frames")) return {};
    const std::filesystem::path path = dataset.folder / "frames.csv";
    const auto table = verify::NumberTable::read(path);
    if (!table) return tl::unexpected(table.error());
    if (table->rows() != frames) {
        return fail(ErrorCode::BadInput,
                    fmt::format("There are {} rows for {} frames; export the dataset again.",
                                table->rows(), frames),
                    path.string());
    }
    constexpr std::array<Quantity, 2> kRates = {Quantity::Speed, Quantity::TurnRate};
    for (const Quantity quantity : kRates) {
        if (table->has(infoOf(quantity).key)) continue;
        return fail(ErrorCode::BadInput,
                    fmt::format("There is no column \"{}\"; export the dataset again.",
                                infoOf(quantity).key),
                    path.string());
    }
    double length_m = 0.0;
    for (std::size_t i = 0; i < frames; ++i) {
        std::array<std::optional<double>, 2> rates;
        for (std::size_t k = 0; k < kRates.size(); ++k) {
            rates[k] = table->number(i, infoOf(kRates[k]).key);
            if (rates[k] && !(*rates[k] >= 0.0 && *rates[k] <= kLargest)) {
                return damagedTable(path, i, infoOf(kRates[k]).key);
            }
        }
        // A rate without the other one has a damaged value, not an empty field.
        if (rates[0].has_value() != rates[1].has_value()) {
            return damagedTable(path, i, infoOf(kRates[rates[0] ? 1 : 0]).key);
        }
        if (!rates[0]) continue;
        statistics.valuesOf(Quantity::Speed).push_back(*rates[0]);
        statistics.valuesOf(Quantity::TurnRate).push_back(*rates[1]);
        if (i == 0) continue;
        length_m += *rates[0] * (dataset.frames[i].time_s - dataset.frames[i - 1].time_s);
    }
    if (!statistics.valuesOf(Quantity::Speed).empty()) statistics.path_length_m = length_m;
    return {};
}

Status addUnusable(const verify::StoredDataset& dataset, DatasetStatistics& statistics) {
    const Json::json_pointer place("/metrics/pictures");
    if (!dataset.card.contains(place)) return {};
    try {
        statistics.pictures = render::pictureTallyFrom(dataset.card.at(place));
    } catch (const Json::exception&) {
        return fail(ErrorCode::BadInput,
                    "This field is missing or has the wrong type; export the dataset again.",
                    (dataset.folder / "dataset.json").string() + ": metrics.pictures");
    }
    return {};
}

}  // namespace

Result<DatasetStatistics> collectStatistics(const verify::StoredDataset& dataset,
                                            const FrameSamples& samples, const JobContext& job) {
    if (dataset.frames.empty()) {
        return fail(ErrorCode::BadInput, "The dataset has no frames; export it again.",
                    dataset.folder.string());
    }
    DatasetStatistics statistics;
    statistics.name = cli::fileBeside(dataset.folder, "").filename().string();
    const Json::json_pointer file("/scene/file");
    if (dataset.card.contains(file) && dataset.card.at(file).is_string()) {
        statistics.scene = dataset.card.at(file).get<std::string>();
    }
    statistics.width_px = dataset.lens.width;
    statistics.height_px = dataset.lens.height;
    statistics.frames = dataset.frames.size();
    std::vector<int> shown = view::evenlySpaced(samples.shown, dataset.frames.size());
    if (samples.shown == 1) {
        shown[0] = static_cast<int>(samples.single_at * static_cast<double>(dataset.frames.size()));
    }
    for (const int frame : shown) statistics.examples.push_back({{}, frame, 0, {}, {}});
    for (const auto add : {addPoses, addMotion, addBoxes, addVisibility, addUnusable}) {
        if (const Status added = add(dataset, statistics); !added) {
            return tl::unexpected(added.error());
        }
    }
    job.report(0.3);
    if (const Status measured = measureImages(dataset, samples.measured, statistics, job);
        !measured) {
        return tl::unexpected(measured.error());
    }
    addExampleImages(dataset, statistics);
    job.report(1.0);
    return statistics;
}

void addStatistics(DatasetStatistics more, DatasetStatistics& sum) {
    sum.datasets += more.datasets;
    if (sum.scene != more.scene) sum.scene.clear();
    sum.frames += more.frames;
    sum.duration_s += more.duration_s;
    if (sum.path_length_m && more.path_length_m) {
        *sum.path_length_m += *more.path_length_m;
    } else {
        sum.path_length_m.reset();
    }
    sum.has_boxes = sum.has_boxes && more.has_boxes;
    sum.boxes += more.boxes;
    sum.boxes_at_border += more.boxes_at_border;
    for (ClassStatistics& row : more.classes) {
        const auto same = std::ranges::find(sum.classes, row.name, &ClassStatistics::name);
        if (same == sum.classes.end()) {
            sum.classes.push_back(std::move(row));
            continue;
        }
        for (const auto number : {&ClassStatistics::boxes, &ClassStatistics::frames,
                                  &ClassStatistics::objects, &ClassStatistics::targets,
                                  &ClassStatistics::captured, &ClassStatistics::well_captured}) {
            (*same).*number += row.*number;
        }
    }
    if (sum.heat_map.boxes.empty()) {
        sum.heat_map = std::move(more.heat_map);
    } else {
        for (std::size_t i = 0; i < more.heat_map.boxes.size(); ++i) {
            sum.heat_map.boxes[i] += more.heat_map.boxes[i];
        }
    }
    const auto append = [](auto& all, const auto& values) {
        all.insert(all.end(), values.begin(), values.end());
    };
    sum.pictures.pictures += more.pictures.pictures;
    append(sum.pictures.dark, more.pictures.dark);
    append(sum.pictures.white, more.pictures.white);
    append(sum.pictures.flat, more.pictures.flat);
    sum.image_frames += more.image_frames;
    sum.images_unreadable += more.images_unreadable;
    append(sum.examples, more.examples);
    for (std::size_t i = 0; i < kQuantities; ++i) append(sum.values[i], more.values[i]);
}

}  // namespace dollytrack::statistics
