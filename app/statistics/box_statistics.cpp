#include "app/statistics/dataset_measurements.h"

#include "app/view/page_data.h"
#include "engine/io/files/text_file.h"
#include "render/verify/read/coco_annotations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace dollytrack::statistics {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kHeatMapCells = 32.0;  // along the longer side of the image

/// A whole number; -1 for any other value.
std::int64_t wholeNumber(const nlohmann::json& value) {
    return value.is_number_integer() ? value.get<std::int64_t>() : -1;
}

/// An annotation that goes with its dataset.
struct Annotation {
    std::size_t frame = 0;
    const DatasetClass* box_class = nullptr;
    const verify::StoredObject* object = nullptr;
    std::array<double, 4> box = {};  // x, y, width, height, px
    double area_px = 0.0;
};

/// Nothing if it is damaged. Throws nlohmann's exceptions.
std::optional<Annotation> annotationFrom(const nlohmann::json& value,
                                         const verify::StoredDataset& dataset) {
    const auto inInt = [](std::int64_t number) {
        return number >= 0 && number <= std::numeric_limits<int>::max();
    };
    const std::int64_t image = wholeNumber(value.at("image_id"));
    const std::int64_t category = wholeNumber(value.at("category_id"));
    const std::int64_t object = wholeNumber(value.at("object_id"));
    if (image < 1 || image > static_cast<std::int64_t>(dataset.frames.size())) return {};
    if (!inInt(category) || !inInt(object)) return {};
    Annotation read;
    read.frame = static_cast<std::size_t>(image) - 1;
    read.box_class = dataset.classes().find(static_cast<int>(category));
    read.object = dataset.object(static_cast<int>(object));
    read.box = value.at("bbox").get<std::array<double, 4>>();
    read.area_px = value.at("area").get<double>();
    const auto& [x, y, width, height] = read.box;
    const bool inside = x >= 0.0 && y >= 0.0 && width >= 1.0 && height >= 1.0 &&
                        x + width <= dataset.lens.width && y + height <= dataset.lens.height;
    const bool fits = read.area_px >= 1.0 && read.area_px <= width * height;
    const bool known =
        read.box_class != nullptr && read.box_class != &dataset.classes().voidClass();
    if (!known || read.object == nullptr || !inside || !fits) return {};
    return read;
}

/// Counts classes, objects and boxes.
class BoxCounter {
  public:
    BoxCounter(const verify::StoredDataset& dataset, DatasetStatistics& statistics)
        : dataset_(dataset), statistics_(statistics), boxes_of_frame_(dataset.frames.size()) {
        const auto& lens = dataset.lens;
        const double cell_px = std::max(lens.width, lens.height) / kHeatMapCells;
        HeatMap& map = statistics_.heat_map;
        map.columns = std::max(1, static_cast<int>(std::lround(lens.width / cell_px)));
        map.rows = std::max(1, static_cast<int>(std::lround(lens.height / cell_px)));
        map.boxes.resize(static_cast<std::size_t>(map.columns) * map.rows);
        for (std::size_t i = 0; i < statistics_.examples.size(); ++i) {
            example_of_[statistics_.examples[i].frame] = i;
        }
    }

    void addTargets() {
        const std::map<int, Json> counted = view::countedRows(dataset_);
        for (const verify::StoredObject& object : dataset_.objects) {
            const DatasetClass* box_class = dataset_.boxClass(object);
            if (object.role != "target" || box_class == nullptr) continue;
            ClassStatistics& row = classes_[box_class->id].numbers;
            ++row.targets;
            const auto at = counted.find(object.id);
            if (at == counted.end()) continue;
            row.captured += isTrue(at->second, "captured") ? 1 : 0;
            row.well_captured += isTrue(at->second, "well_captured") ? 1 : 0;
            const Json fraction = at->second.value("visible_fraction", Json());
            if (!fraction.is_number()) continue;
            const double best = fraction.get<double>();
            if (best > 0.0 && best <= 1.0) {
                statistics_.valuesOf(Quantity::BestVisibleFraction).push_back(best);
            }
        }
    }

    void add(const Annotation& annotation) {
        const auto& [x, y, width, height] = annotation.box;
        const auto image_width = static_cast<double>(dataset_.lens.width);
        const auto image_height = static_cast<double>(dataset_.lens.height);
        ++statistics_.boxes;
        ++boxes_of_frame_[annotation.frame];
        Tally& tally = classes_[annotation.box_class->id];
        ++tally.numbers.boxes;
        tally.frames.insert(annotation.frame);
        tally.objects.insert(annotation.object->id);
        const bool at_border =
            x <= 0.0 || y <= 0.0 || x + width >= image_width || y + height >= image_height;
        statistics_.boxes_at_border += at_border ? 1 : 0;
        statistics_.valuesOf(Quantity::BoxShare)
            .push_back(width * height / (image_width * image_height));
        statistics_.valuesOf(Quantity::MaskShare)
            .push_back(annotation.area_px / (image_width * image_height));
        statistics_.valuesOf(Quantity::AspectRatio).push_back(width / height);
        statistics_.valuesOf(Quantity::Distance)
            .push_back(cameraFromBox(*annotation.object, dataset_.frames[annotation.frame])
                           .translation()
                           .norm());
        const auto cell = [](double at, double size, int cells) {
            return std::min(cells - 1, static_cast<int>(at / size * cells));
        };
        HeatMap& map = statistics_.heat_map;
        const int column = cell(x + 0.5 * width, image_width, map.columns);
        const int row = cell(y + 0.5 * height, image_height, map.rows);
        ++map.boxes[static_cast<std::size_t>(row) * map.columns + column];
        addToExample(annotation);
    }

    void finish() {
        for (const int boxes : boxes_of_frame_) {
            statistics_.valuesOf(Quantity::BoxesPerFrame).push_back(boxes);
        }
    }

    void finishClasses() {
        for (const DatasetClass& known : dataset_.classes().classes()) {
            const auto at = classes_.find(known.id);
            if (at == classes_.end()) continue;
            ClassStatistics& row = at->second.numbers;
            row.id = known.id;
            row.name = known.name;
            row.frames = at->second.frames.size();
            row.objects = at->second.objects.size();
            statistics_.classes.push_back(row);
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

    void addToExample(const Annotation& annotation) {
        const auto at = example_of_.find(static_cast<int>(annotation.frame));
        if (at == example_of_.end()) return;
        ExampleFrame& example = statistics_.examples[at->second];
        ++example.boxes;
        if (example.shown_boxes.size() >= kMostExampleBoxes) return;
        example.shown_boxes.push_back({annotation.box, annotation.object->name,
                                       annotation.box_class->name, annotation.box_class->color});
    }

    const verify::StoredDataset& dataset_;
    DatasetStatistics& statistics_;
    std::map<int, Tally> classes_;  // by class id
    std::vector<int> boxes_of_frame_;
    std::map<int, std::size_t> example_of_;  // index of the example by frame
};

}  // namespace

Status addBoxes(const verify::StoredDataset& dataset, DatasetStatistics& statistics) {
    BoxCounter counter(dataset, statistics);
    counter.addTargets();
    statistics.has_boxes = dataset.has("coco");
    if (statistics.has_boxes) {
        const std::filesystem::path path = dataset.folder / "annotations.json";
        const Result<std::string> text = readText(path);
        if (!text) return tl::unexpected(text.error());
        const Status read =
            verify::forEachAnnotation(*text, path.string(), [&](const nlohmann::json& value) {
                const std::optional<Annotation> annotation = annotationFrom(value, dataset);
                if (annotation) counter.add(*annotation);
                return annotation.has_value();
            });
        if (!read) return read;
        counter.finish();
    }
    counter.finishClasses();
    return {};
}

}  // namespace dollytrack::statistics
