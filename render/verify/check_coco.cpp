#include "engine/scene/labels.h"
#include "render/verify/check_list.h"
#include "render/verify/object_pixels.h"
#include "render/verify/run_lengths.h"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <set>

namespace dollytrack::verify {
namespace {

using Json = nlohmann::json;

constexpr const char* kFile = "annotations.json";

struct Annotation {
    int id = 0;
    int category = 0;
    int object_id = 0;
    double area = 0.0;
    std::array<double, 4> box = {};
    std::array<int, 2> size = {};  // height, width
    std::string runs;
};

/// The annotations of each frame.
using ByFrame = std::vector<std::vector<Annotation>>;

Annotation annotationFrom(const Json& one) {
    Annotation read;
    read.id = one.at("id").get<int>();
    read.category = one.at("category_id").get<int>();
    read.object_id = one.at("object_id").get<int>();
    read.area = one.at("area").get<double>();
    read.box = one.at("bbox").get<std::array<double, 4>>();
    const Json& segmentation = one.at("segmentation");
    read.size = segmentation.at("size").get<std::array<int, 2>>();
    read.runs = segmentation.at("counts").get<std::string>();
    return read;
}

/// What can be said without the images: numbers, names, and that all refer to what there is.
class CocoReader {
  public:
    CocoReader(const StoredDataset& dataset, Findings& findings)
        : dataset_(dataset), findings_(findings), by_frame_(dataset.frames.size()) {}

    ByFrame read(const Json& root) {
        for (const Json& one : root.at("categories")) {
            const int id = one.at("id").get<int>();
            categories_.insert(id);
            const std::string name = one.at("name").get<std::string>();
            if (id < 1 || id > kNyu40Count || name != nyu40Name(id)) {
                add({}, fmt::format("category {} is {}", id, name), "NYU40's own");
            }
        }
        for (const Json& one : root.at("images")) readImage(one);
        if (frame_of_.size() != dataset_.frames.size()) {
            add({}, fmt::format("{} images", frame_of_.size()),
                fmt::format("{}", dataset_.frames.size()));
        }
        for (const Json& one : root.at("annotations")) readAnnotation(one);
        return std::move(by_frame_);
    }

  private:
    void add(std::optional<int> frame, std::string found, std::string expected) {
        findings_.add({kFile, frame, {}, std::move(found), std::move(expected)});
    }

    void readImage(const Json& one) {
        const int id = one.at("id").get<int>();
        const int frame = id - 1;
        if (frame < 0 || frame >= static_cast<int>(dataset_.frames.size())) {
            return add({}, fmt::format("image id {}", id), "the number of a frame + 1");
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

    void readAnnotation(const Json& json) {
        Annotation one = annotationFrom(json);
        const int image = json.at("image_id").get<int>();
        const auto at = frame_of_.find(image);
        if (at == frame_of_.end()) {
            return add({}, fmt::format("annotation {} is of image {}", one.id, image),
                       "an image of the list");
        }
        const int frame = at->second;
        if (one.id < 1 || !ids_.insert(one.id).second) {
            add(frame, fmt::format("annotation id {}", one.id), "numbers from 1 on, each once");
        }
        if (!categories_.contains(one.category)) {
            add(frame, fmt::format("annotation {} has category {}", one.id, one.category),
                "a category of the list");
        }
        checkObject(frame, one);
        by_frame_[static_cast<std::size_t>(frame)].push_back(std::move(one));
    }

    void checkObject(int frame, const Annotation& one) {
        const StoredObject* object = dataset_.object(one.object_id);
        if (!object || object->role != "target") {
            return add(frame, fmt::format("annotation {} is of object {}", one.id, one.object_id),
                       "a target of dataset.json's objects");
        }
        const int expected = object->nyu40 == kNyuUnknown ? kNyuOtherProp : object->nyu40;
        if (one.category != expected) {
            add(frame, fmt::format("annotation {} has category {}", one.id, one.category),
                fmt::format("{}, the class of object {}", expected, one.object_id));
        }
    }

    const StoredDataset& dataset_;
    Findings& findings_;
    ByFrame by_frame_;
    std::set<int> categories_, ids_;
    std::map<int, int> frame_of_;
};

/// Where the mask and the id image differ first; nothing when they are the same.
void compareMask(const Annotation& one, const Image16& ids, int frame, Findings& findings) {
    const auto add = [&](std::optional<std::array<int, 2>> pixel, std::string found,
                         std::string expected) {
        findings.add({kFile, frame, pixel, fmt::format("annotation {}: {}", one.id, found),
                      std::move(expected)});
    };
    if (one.size != std::array{ids.height, ids.width}) {
        return add({}, fmt::format("size {} x {}", one.size[0], one.size[1]),
                   fmt::format("{} x {}", ids.height, ids.width));
    }
    const auto mask = maskFrom(readRunLengths(one.runs), ids.width, ids.height);
    if (mask.empty()) {
        return add({}, "run lengths that do not sum up to the image",
                   fmt::format("{}", ids.values.size()));
    }
    auto in_mask = mask.begin();
    for (int x = 0; x < ids.width; ++x) {
        for (int y = 0; y < ids.height; ++y, ++in_mask) {
            const bool shown = ids.at(x, y) == one.object_id;
            if (shown == (*in_mask != 0)) continue;
            return add(std::array{x, y}, *in_mask != 0 ? "inside the mask" : "outside the mask",
                       fmt::format("object {} in the instance image", ids.at(x, y)));
        }
    }
}

void compareFrame(const StoredDataset& dataset, const std::vector<Annotation>& annotations,
                  FrameImages& images, Findings& findings) {
    const Image16* ids = images.image16("instance");
    if (!ids) return;
    const auto seen = objectPixels(*ids);
    const int frame = images.frame();
    std::set<int> annotated;
    for (const Annotation& one : annotations) {
        annotated.insert(one.object_id);
        const auto at = seen.find(one.object_id);
        const ObjectPixels shown = at == seen.end() ? ObjectPixels{} : at->second;
        if (one.area != shown.count) {
            findings.add({kFile,
                          frame,
                          {},
                          fmt::format("annotation {}: area {}", one.id, one.area),
                          fmt::format("{} px", shown.count)});
        }
        if (shown.count > 0 && one.box != shown.box()) {
            const auto text = [](const std::array<double, 4>& b) {
                return fmt::format("[{}, {}, {}, {}]", b[0], b[1], b[2], b[3]);
            };
            findings.add({kFile,
                          frame,
                          {},
                          fmt::format("annotation {}: bbox {}", one.id, text(one.box)),
                          text(shown.box())});
        }
        compareMask(one, *ids, frame, findings);
    }
    for (const auto& [id, shown] : seen) {
        const StoredObject* object = dataset.object(id);
        if (!object || object->role != "target" || annotated.contains(id)) continue;
        findings.add({kFile, frame, std::array{shown.x0, shown.y0},
                      fmt::format("no annotation of object {}", id), "one"});
    }
    if (annotated.size() != annotations.size()) {
        findings.add({kFile, frame, {}, "an object twice", "one annotation an object"});
    }
}

}  // namespace

CheckWork beginCoco(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    auto annotations = std::make_shared<ByFrame>();
    try {
        std::ifstream file(dataset.folder / kFile);
        *annotations = CocoReader(dataset, findings).read(Json::parse(file));
    } catch (const Json::exception& error) {
        findings.add({kFile, {}, {}, error.what(), "COCO instances"});
        return {};
    }
    CheckWork work;
    work.frame = [&dataset, annotations](FrameImages& images, Findings& found) {
        compareFrame(dataset, (*annotations)[static_cast<std::size_t>(images.frame())], images,
                     found);
    };
    return work;
}

}  // namespace dollytrack::verify
