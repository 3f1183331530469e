#include "render/formats/labels/coco.h"

#include "render/formats/labels/mask_outline.h"

#include <nlohmann/json.hpp>

#include <array>
#include <numeric>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

enum class Segmentation { RunLengths, Polygons };

Json segmentation(const ObjectMask& mask, int width, int height, Segmentation kind) {
    if (kind == Segmentation::RunLengths) {
        return {{"size", {height, width}}, {"counts", compressCounts(mask.counts)}};
    }
    Json polygons = Json::array();
    for (const Outline& outline : outlinesOfCounts(width, height, mask.counts)) {
        if (outline.hole) continue;
        Json corners = Json::array();
        for (const Eigen::Vector2i& corner : outline.corners) {
            corners.push_back(corner.x());
            corners.push_back(corner.y());
        }
        polygons.push_back(std::move(corners));
    }
    return polygons;
}

/// Adds the object's visible share and its occluder.
void addAttributes(const DatasetFrame& frame, int object_id, Json& annotation) {
    for (const InstanceInFrame& seen : frame.instances) {
        if (seen.object_id != object_id) continue;
        annotation["attributes"] = {{"visible_fraction", seen.visibleFraction()},
                                    {"truncation", seen.truncation()},
                                    {"occluder", seen.occluder},
                                    {"occluder_fraction", seen.occluderFraction()}};
    }
}

std::string textOf(const DatasetContents& contents, std::span<const int> frames,
                   Segmentation kind) {
    const Scene& scene = contents.scene;
    const int width = contents.camera.width_px;
    const int height = contents.camera.height_px;
    // Lists are built separately, because adding a key invalidates references into an ordered
    // object.
    Json root;
    root["info"] = {{"description", "Dollytrack dataset of " + scene.name}, {"version", "1.0"}};
    root["licenses"] = Json::array();
    Json categories = Json::array();
    for (const DatasetClass& one : scene.classes().classes()) {
        // Readers require the key; a class without supercategory is its own.
        const std::string& above = one.supercategory.empty() ? one.name : one.supercategory;
        categories.push_back({{"id", one.id}, {"name", one.name}, {"supercategory", above}});
    }
    Json images = Json::array();
    Json annotations = Json::array();
    for (const int index : frames) {
        const DatasetFrame& frame = contents.frames[index];
        images.push_back({{"id", index + 1},
                          {"file_name", contents.pictureFile(index)},
                          {"width", width},
                          {"height", height}});
        for (const ObjectMask& mask : frame.masks) {
            const Object& object = scene.object(mask.object_id);
            const DatasetClass* category = scene.classes().boxClassOf(object);
            if (object.role != Role::Target || mask.area == 0 || category == nullptr) continue;
            annotations.push_back({{"id", annotations.size() + 1},
                                   {"image_id", index + 1},
                                   {"category_id", category->id},
                                   {"iscrowd", 0},
                                   {"area", mask.area},
                                   {"bbox", mask.bbox},
                                   {"segmentation", segmentation(mask, width, height, kind)},
                                   {"object_id", object.id}});
            // Amodal masks are measured for polygons only; annotations.json must not depend on
            // which other formats are written.
            if (kind == Segmentation::Polygons) {
                addAttributes(frame, object.id, annotations.back());
            }
        }
    }
    root["categories"] = std::move(categories);
    root["images"] = std::move(images);
    root["annotations"] = std::move(annotations);
    // Object names may contain invalid UTF-8, which must not end the export.
    return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<int> allOf(const DatasetContents& contents) {
    std::vector<int> all(contents.frames.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
}

}  // namespace

std::string cocoText(const DatasetContents& contents) {
    return cocoText(contents, allOf(contents));
}

std::string cocoText(const DatasetContents& contents, std::span<const int> frames) {
    return textOf(contents, frames, Segmentation::RunLengths);
}

std::string cocoPolygonsText(const DatasetContents& contents) {
    return textOf(contents, allOf(contents), Segmentation::Polygons);
}

namespace {

constexpr std::array<const char*, 1> kCocoFiles = {"annotations.json"};
constexpr std::array<const char*, 1> kPolygonFiles = {"annotations_polygons.json"};

Result<std::vector<DatasetFile>> writeCoco(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kCocoFiles[0], cocoText(contents)}};
}

nlohmann::ordered_json cocoConvention(const DatasetContents& contents) {
    const std::string category = contents.scene.classes().isNyu40()
                                     ? "the NYU40 class (40 for targets of unknown class)"
                                     : "the id in classes (targets of class void have none)";
    return {{"file", kCocoFiles[0]},
            {"format", "COCO instances, compressed run lengths; targets only; category_id is " +
                           category + "; image_id is the frame + 1"}};
}

Result<std::vector<DatasetFile>> writePolygons(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kPolygonFiles[0], cocoPolygonsText(contents)}};
}

nlohmann::ordered_json polygonsConvention(const DatasetContents& /*contents*/) {
    return {{"file", kPolygonFiles[0]},
            {"format",
             "like annotations.json, but with outlines along pixel borders (holes filled) and the "
             "attributes of instances.csv"}};
}

}  // namespace

const Format kCocoFormat = {
    .name = "coco",
    .text = "COCO instances: boxes and masks of the targets, in annotations.json",
    .group = ContentGroup::Labels,
    .standard = true,
    .needs = kNeedsMasks,
    .files = kCocoFiles,
    .write = writeCoco,
    .convention = cocoConvention,
    .outlines_things = true,
};

const Format kCocoPolygonsFormat = {
    .name = "coco_polygons",
    .text = "COCO instances with outlines and attributes, in annotations_polygons.json",
    .group = ContentGroup::Labels,
    .needs = kNeedsMasks | kNeedsWhole,
    .files = kPolygonFiles,
    .write = writePolygons,
    .convention = polygonsConvention,
    .outlines_things = true,
};

}  // namespace dollytrack::render
