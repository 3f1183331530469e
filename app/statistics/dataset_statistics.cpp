#include "app/statistics/dataset_statistics.h"

#include "app/statistics/image_statistics.h"
#include "app/view/even_frames.h"
#include "app/view/page_data.h"
#include "engine/io/files/text_file.h"
#include "render/formats/tables/dataset_card.h"
#include "render/verify/read/coco_annotations.h"
#include "render/verify/read/number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

namespace dollytrack::statistics {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kHeatMapColumns = 32;
constexpr int kFloorClass = 2;  // NYU40
// Beyond this a file is damaged; axes could not be drawn.
constexpr double kLargest = 1e6;
constexpr double kLongest_s = 1e9;

/// A whole number; -1 for any other value.
std::int64_t wholeNumber(const nlohmann::json& value) {
    return value.is_number_integer() ? value.get<std::int64_t>() : -1;
}

/// An annotation that goes with its dataset.
struct Annotation {
    std::size_t frame = 0;
    const DatasetClass* of_class = nullptr;
    const verify::StoredObject* object = nullptr;
    std::array<double, 4> box = {};  // x, y, width, height, px
    double area_px = 0.0;
};

/// Nothing if it is damaged. Throws nlohmann's exceptions.
std::optional<Annotation> annotationFrom(const nlohmann::json& one,
                                         const verify::StoredDataset& dataset) {
    const auto inInt = [](std::int64_t number) {
        return number >= 0 && number <= std::numeric_limits<int>::max();
    };
    const std::int64_t image = wholeNumber(one.at("image_id"));
    const std::int64_t category = wholeNumber(one.at("category_id"));
    const std::int64_t object = wholeNumber(one.at("object_id"));
    if (image < 1 || image > static_cast<std::int64_t>(dataset.frames.size())) return {};
    if (!inInt(category) || !inInt(object)) return {};
    Annotation read;
    read.frame = static_cast<std::size_t>(image) - 1;
    read.of_class = dataset.classes().find(static_cast<int>(category));
    read.object = dataset.object(static_cast<int>(object));
    read.box = one.at("bbox").get<std::array<double, 4>>();
    read.area_px = one.at("area").get<double>();
    const auto& [x, y, width, height] = read.box;
    const bool inside = x >= 0.0 && y >= 0.0 && width >= 1.0 && height >= 1.0 &&
                        x + width <= dataset.lens.width && y + height <= dataset.lens.height;
    const bool fits = read.area_px >= 1.0 && read.area_px <= width * height;
    const bool known = read.of_class != nullptr && read.of_class != &dataset.classes().voidClass();
    if (!known || read.object == nullptr || !inside || !fits) return {};
    return read;
}

/// Counts classes, objects and boxes.
class BoxCounter {
  public:
    BoxCounter(const verify::StoredDataset& dataset, DatasetStatistics& into)
        : dataset_(dataset), into_(into), boxes_of_frame_(dataset.frames.size()) {
        const auto& lens = dataset.lens;
        into_.heat_map.columns = kHeatMapColumns;
        into_.heat_map.rows =
            std::clamp(static_cast<int>(std::lround(static_cast<double>(kHeatMapColumns) *
                                                    lens.height / lens.width)),
                       1, 4 * kHeatMapColumns);
        into_.heat_map.boxes.resize(static_cast<std::size_t>(kHeatMapColumns) *
                                    into_.heat_map.rows);
        for (std::size_t i = 0; i < into_.examples.size(); ++i) {
            example_of_[into_.examples[i].frame] = i;
        }
    }

    void addTargets() {
        const std::map<int, Json> counted = view::countedRows(dataset_);
        for (const verify::StoredObject& object : dataset_.objects) {
            const DatasetClass* of_class = dataset_.boxClass(object);
            if (object.role != "target" || of_class == nullptr) continue;
            ClassStatistics& row = classes_[of_class->id].numbers;
            ++row.targets;
            const auto at = counted.find(object.id);
            if (at == counted.end()) continue;
            row.captured += isTrue(at->second, "captured") ? 1 : 0;
            row.well_captured += isTrue(at->second, "well_captured") ? 1 : 0;
            const Json fraction = at->second.value("visible_fraction", Json());
            if (!fraction.is_number()) continue;
            const double best = fraction.get<double>();
            if (best > 0.0 && best <= 1.0) into_.of(Quantity::BestVisibleFraction).push_back(best);
        }
    }

    void add(const Annotation& one) {
        const auto& [x, y, width, height] = one.box;
        const auto image_width = static_cast<double>(dataset_.lens.width);
        const auto image_height = static_cast<double>(dataset_.lens.height);
        ++into_.boxes;
        ++boxes_of_frame_[one.frame];
        Tally& tally = classes_[one.of_class->id];
        ++tally.numbers.boxes;
        tally.frames.insert(one.frame);
        tally.objects.insert(one.object->id);
        const bool at_border =
            x <= 0.0 || y <= 0.0 || x + width >= image_width || y + height >= image_height;
        into_.boxes_at_border += at_border ? 1 : 0;
        into_.of(Quantity::BoxShare).push_back(width * height / (image_width * image_height));
        into_.of(Quantity::MaskShare).push_back(one.area_px / (image_width * image_height));
        into_.of(Quantity::AspectRatio).push_back(width / height);
        into_.of(Quantity::Distance)
            .push_back(cameraFromBox(*one.object, dataset_.frames[one.frame]).translation().norm());
        const auto cell = [](double at, double size, int cells) {
            return std::min(cells - 1, static_cast<int>(at / size * cells));
        };
        HeatMap& map = into_.heat_map;
        const int column = cell(x + 0.5 * width, image_width, map.columns);
        const int row = cell(y + 0.5 * height, image_height, map.rows);
        ++map.boxes[static_cast<std::size_t>(row) * map.columns + column];
        addToExample(one);
    }

    void finish() {
        for (const int boxes : boxes_of_frame_) {
            into_.of(Quantity::BoxesPerFrame).push_back(boxes);
        }
    }

    void finishClasses() {
        for (const DatasetClass& one : dataset_.classes().classes()) {
            const auto at = classes_.find(one.id);
            if (at == classes_.end()) continue;
            ClassStatistics& row = at->second.numbers;
            row.id = one.id;
            row.name = one.name;
            row.frames = at->second.frames.size();
            row.objects = at->second.objects.size();
            into_.classes.push_back(row);
        }
    }

  private:
    struct Tally {
        ClassStatistics numbers;
        std::set<std::size_t> frames;
        std::set<int> objects;
    };

    static bool isTrue(const Json& row, const char* name) {
        return row.contains(name) && row[name].is_boolean() && row[name].get<bool>();
    }

    void addToExample(const Annotation& one) {
        const auto at = example_of_.find(static_cast<int>(one.frame));
        if (at == example_of_.end()) return;
        ExampleFrame& example = into_.examples[at->second];
        ++example.boxes;
        if (example.shown_boxes.size() >= kMostExampleBoxes) return;
        example.shown_boxes.push_back(
            {one.box, one.object->name, one.of_class->name, one.of_class->color});
    }

    const verify::StoredDataset& dataset_;
    DatasetStatistics& into_;
    std::map<int, Tally> classes_;  // by class id
    std::vector<int> boxes_of_frame_;
    std::map<int, std::size_t> example_of_;  // index of the example by frame
};

Status addBoxes(const verify::StoredDataset& dataset, DatasetStatistics& into) {
    BoxCounter counter(dataset, into);
    counter.addTargets();
    into.has_boxes = dataset.has("coco");
    if (into.has_boxes) {
        const std::filesystem::path path = dataset.folder / "annotations.json";
        const Result<std::string> text = readText(path);
        if (!text) return tl::unexpected(text.error());
        const Status read =
            verify::forEachAnnotation(*text, path.string(), [&](const nlohmann::json& value) {
                const std::optional<Annotation> one = annotationFrom(value, dataset);
                if (one) counter.add(*one);
                return one.has_value();
            });
        if (!read) return read;
        counter.finish();
    }
    counter.finishClasses();
    return {};
}

tl::unexpected<Error> damagedTable(const std::filesystem::path& path, std::size_t row,
                                   const char* column) {
    return fail(ErrorCode::BadInput,
                fmt::format("The value of {} is missing or out of range; export the dataset again.",
                            column),
                fmt::format("{}:{}", path.string(), row + 2));
}

/// Visible fractions and truncations, from instances.csv.
Status addVisibility(const verify::StoredDataset& dataset, DatasetStatistics& into) {
    if (!dataset.has("instances")) return {};
    const std::filesystem::path path = dataset.folder / "instances.csv";
    const auto table = verify::NumberTable::read(path);
    if (!table) return tl::unexpected(table.error());
    for (std::size_t i = 0; i < table->rows(); ++i) {
        for (const Quantity quantity : {Quantity::VisibleFraction, Quantity::Truncation}) {
            const char* column = infoOf(quantity).key;
            const std::optional<double> value = table->number(i, column);
            if (!value || *value < 0.0 || *value > 1.0) return damagedTable(path, i, column);
            into.of(quantity).push_back(*value);
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

Status addPoses(const verify::StoredDataset& dataset, DatasetStatistics& into) {
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
        into.time_s.push_back(frame.time_s);
        const double sine = std::clamp(frame.pose.forward().z(), -1.0, 1.0);
        into.along[0].emplace_back(heightOf(frame.pose.position, floors));
        into.along[1].emplace_back(std::asin(sine) * 180.0 / std::numbers::pi);
    }
    if (!into.time_s.empty()) into.duration_s = into.time_s.back() - into.time_s.front();
    return {};
}

/// Speeds, turn rates and length of the path, from frames.csv. They are missing where a path
/// begins.
Status addMotion(const verify::StoredDataset& dataset, DatasetStatistics& into) {
    const std::size_t frames = dataset.frames.size();
    into.along[2].resize(frames);
    into.along[3].resize(frames);
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
    double length_m = 0.0;
    for (std::size_t i = 0; i < frames; ++i) {
        for (const std::size_t line : {std::size_t{2}, std::size_t{3}}) {
            const char* column = infoOf(kAlongTrajectory[line]).key;
            const std::optional<double> value = table->number(i, column);
            if (value && !(*value >= 0.0 && *value <= kLargest)) {
                return damagedTable(path, i, column);
            }
            into.along[line][i] = value;
        }
        if (i > 0 && into.along[2][i]) {
            length_m += *into.along[2][i] * (into.time_s[i] - into.time_s[i - 1]);
        }
    }
    into.path_length_m = length_m;
    return {};
}

void addAlongToSamples(DatasetStatistics& into) {
    for (std::size_t line = 0; line < kAlongTrajectory.size(); ++line) {
        for (const std::optional<double>& value : into.along[line]) {
            if (value) into.of(kAlongTrajectory[line]).push_back(*value);
        }
    }
}

Status addUnusable(const verify::StoredDataset& dataset, DatasetStatistics& into) {
    const Json::json_pointer place("/metrics/pictures");
    if (!dataset.card.contains(place)) return {};
    try {
        const render::PictureTally tally = render::pictureTallyFrom(dataset.card.at(place));
        into.unusable = {static_cast<std::size_t>(std::max(0, tally.pictures)), tally.dark.size(),
                         tally.white.size(), tally.flat.size()};
    } catch (const Json::exception&) {
        return fail(ErrorCode::BadInput,
                    "This field is missing or has the wrong type; export the dataset again.",
                    (dataset.folder / "dataset.json").string() + ": metrics.pictures");
    }
    return {};
}

}  // namespace

Result<DatasetStatistics> collectStatistics(const verify::StoredDataset& dataset,
                                            std::size_t examples, const JobContext& job) {
    if (dataset.frames.empty()) {
        return fail(ErrorCode::BadInput, "The dataset has no frames; export it again.",
                    dataset.folder.string());
    }
    DatasetStatistics statistics;
    std::error_code error;
    const auto path = std::filesystem::absolute(dataset.folder / "", error).lexically_normal();
    statistics.name = path.parent_path().filename().string();
    const Json::json_pointer file("/scene/file");
    if (dataset.card.contains(file) && dataset.card.at(file).is_string()) {
        statistics.scene = dataset.card.at(file).get<std::string>();
    }
    statistics.width_px = dataset.lens.width;
    statistics.height_px = dataset.lens.height;
    statistics.frames = dataset.frames.size();
    for (const int frame : view::evenlySpaced(examples, dataset.frames.size())) {
        statistics.examples.push_back({frame, 0, {}, {}});
    }
    for (const auto add : {addPoses, addMotion, addBoxes, addVisibility, addUnusable}) {
        if (const Status added = add(dataset, statistics); !added) {
            return tl::unexpected(added.error());
        }
    }
    addAlongToSamples(statistics);
    job.report(0.3);
    if (const Status measured = measureImages(dataset, statistics, job); !measured) {
        return tl::unexpected(measured.error());
    }
    addExampleImages(dataset, statistics);
    job.report(1.0);
    return statistics;
}

}  // namespace dollytrack::statistics
