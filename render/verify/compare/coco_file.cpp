#include "render/verify/compare/coco_file.h"

#include "engine/io/files/bounded_json.h"
#include "render/verify/read/json_file.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace dollytrack::verify {
namespace {

using PlainJson = nlohmann::json;

CocoAnnotation annotationFrom(const PlainJson& one) {
    CocoAnnotation read;
    read.id = one.at("id").get<int>();
    read.category = one.at("category_id").get<int>();
    read.object_id = one.at("object_id").get<int>();
    read.area = one.at("area").get<double>();
    read.box = one.at("bbox").get<std::array<double, 4>>();
    read.segmentation = one.at("segmentation");
    read.attributes = one.value("attributes", PlainJson());
    return read;
}

class CocoReader {
  public:
    CocoReader(const StoredDataset& dataset, const std::string& file, std::span<const int> frames,
               Findings& findings)
        : dataset_(dataset),
          file_(file),
          frames_(frames.begin(), frames.end()),
          findings_(findings),
          by_frame_(dataset.frames.size()) {}

    CocoByFrame read(const PlainJson& root) {
        const ClassTable& classes = dataset_.classes();
        for (const PlainJson& one : root.at("categories")) {
            const int id = one.at("id").get<int>();
            categories_.insert(id);
            const std::string name = one.at("name").get<std::string>();
            const DatasetClass* known = classes.find(id);
            if (known == nullptr || known == &classes.voidClass() || name != known->name) {
                add({}, fmt::format("category {} is {}", id, name),
                    classes.isNyu40() ? "NYU40's own" : "one of the dataset's classes");
            }
        }
        if (!classes.isNyu40() && categories_.size() != classes.classes().size()) {
            add({}, fmt::format("{} categories", categories_.size()),
                fmt::format("{}", classes.classes().size()));
        }
        for (const PlainJson& one : root.at("images")) readImage(one);
        if (frame_of_.size() != frames_.size()) {
            add({}, fmt::format("{} images", frame_of_.size()), fmt::format("{}", frames_.size()));
        }
        for (const PlainJson& one : root.at("annotations")) readAnnotation(one);
        return std::move(by_frame_);
    }

  private:
    void add(std::optional<int> frame, std::string found, std::string expected) {
        findings_.add({file_, frame, {}, std::move(found), std::move(expected)});
    }

    void readImage(const PlainJson& one) {
        const int id = one.at("id").get<int>();
        const int frame = id - 1;
        if (!frames_.contains(frame)) {
            return add({}, fmt::format("image id {}", id), "a listed frame number + 1");
        }
        if (!frame_of_.emplace(id, frame).second) {
            return add(frame, fmt::format("image id {} twice", id), "once");
        }
        const std::string file = one.at("file_name").get<std::string>();
        const bool numbered = file.find(fmt::format("/{:06}.", frame)) != std::string::npos;
        if (!numbered || !dataset_.sha256s.contains(file)) {
            add(frame, "file_name " + file, fmt::format("an image of frame {}", frame));
        }
        const int width = one.at("width").get<int>();
        const int height = one.at("height").get<int>();
        if (width != dataset_.lens.width || height != dataset_.lens.height) {
            add(frame, fmt::format("{} x {} px", width, height),
                fmt::format("{} x {}", dataset_.lens.width, dataset_.lens.height));
        }
    }

    void readAnnotation(const PlainJson& json) {
        CocoAnnotation one = annotationFrom(json);
        const int image = json.at("image_id").get<int>();
        const auto at = frame_of_.find(image);
        if (at == frame_of_.end()) {
            return add({}, fmt::format("annotation {} is of image {}", one.id, image),
                       "an image of the list");
        }
        const int frame = at->second;
        if (one.id < 1 || !ids_.insert(one.id).second) {
            add(frame, fmt::format("annotation id {}", one.id), "numbers from 1, each once");
        }
        if (!categories_.contains(one.category)) {
            add(frame, fmt::format("annotation {} has category {}", one.id, one.category),
                "a category of the list");
        }
        checkObject(frame, one);
        by_frame_[frame].push_back(std::move(one));
    }

    void checkObject(int frame, const CocoAnnotation& one) {
        const StoredObject* object = dataset_.object(one.object_id);
        if (!object || object->role != "target") {
            return add(frame, fmt::format("annotation {} is of object {}", one.id, one.object_id),
                       "a target of dataset.json's objects");
        }
        const DatasetClass* expected = dataset_.boxClass(*object);
        if (expected == nullptr) {
            add(frame, fmt::format("annotation {} is of object {}", one.id, one.object_id),
                "none, because its class is void");
        } else if (one.category != expected->id) {
            add(frame, fmt::format("annotation {} has category {}", one.id, one.category),
                fmt::format("{}, the class of object {}", expected->id, one.object_id));
        }
    }

    const StoredDataset& dataset_;
    const std::string& file_;
    const std::set<int> frames_;
    Findings& findings_;
    CocoByFrame by_frame_;
    std::set<int> categories_, ids_;
    std::map<int, int> frame_of_;
};

}  // namespace

std::optional<CocoByFrame> readCoco(const StoredDataset& dataset, const std::string& file,
                                    std::span<const int> frames, Findings& findings) {
    const Result<PlainJson> root = readJson(dataset.folder / file);
    if (!root) {
        findings.add({file, {}, {}, root.error().message, "COCO"});
        return std::nullopt;
    }
    try {
        return CocoReader(dataset, file, frames, findings).read(*root);
    } catch (const PlainJson::exception& error) {
        findings.add({file, {}, {}, plainReason(error), "COCO"});
    }
    return std::nullopt;
}

void compareCoco(const StoredDataset& dataset, const std::string& file,
                 const std::vector<CocoAnnotation>& annotations, FrameImages& images,
                 const CompareMask& compare_mask, Findings& findings) {
    const Image16* ids = images.image16("instance");
    if (!ids) return;
    const auto& seen = images.seen();
    const int frame = images.frame();
    std::set<int> annotated;
    for (const CocoAnnotation& one : annotations) {
        annotated.insert(one.object_id);
        const auto at = seen.find(one.object_id);
        const ObjectPixels shown = at == seen.end() ? ObjectPixels{} : at->second;
        if (one.area != shown.count) {
            findings.add({file,
                          frame,
                          {},
                          fmt::format("annotation {}: area {}", one.id, one.area),
                          fmt::format("{} px", shown.count)});
        }
        if (shown.count > 0 && one.box != shown.box()) {
            const auto text = [](const std::array<double, 4>& b) {
                return fmt::format("[{}, {}, {}, {}]", b[0], b[1], b[2], b[3]);
            };
            findings.add({file,
                          frame,
                          {},
                          fmt::format("annotation {}: bbox {}", one.id, text(one.box)),
                          text(shown.box())});
        }
        try {
            compare_mask(one, *ids, frame, findings);
        } catch (const PlainJson::exception& error) {
            findings.add({file,
                          frame,
                          {},
                          fmt::format("annotation {}: {}", one.id, plainReason(error)),
                          "a segmentation"});
        }
    }
    for (const auto& [id, shown] : seen) {
        const StoredObject* object = dataset.object(id);
        if (!object || object->role != "target" || annotated.contains(id)) continue;
        if (dataset.boxClass(*object) == nullptr) continue;
        findings.add({file, frame, std::array{shown.x0, shown.y0},
                      fmt::format("no annotation of object {}", id), "one"});
    }
    if (annotated.size() != annotations.size()) {
        findings.add({file, frame, {}, "an object twice", "one annotation per object"});
    }
}

}  // namespace dollytrack::verify
