#include "render/formats/coco.h"

#include "engine/scene/labels.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

std::string superCategory(int nyu40) {
    switch (nyu40) {
        case kNyuWall:
        case kNyuFloor:
        case kNyuDoor:
        case kNyuWindow:
        case kNyuCeiling:
        case kNyuOtherStructure:
            return "structure";
        default:
            return nyu40 == kNyuOtherProp ? "prop" : "furnishing";
    }
}

}  // namespace

std::string cocoText(const DatasetContents& contents) {
    const Scene& scene = contents.scene;
    const int width = contents.camera.width_px;
    const int height = contents.camera.height_px;
    // Lists are built apart: a reference into an ordered object ends with its next key.
    Json root;
    root["info"] = {{"description", "Dollytrack dataset of " + scene.name}, {"version", "1.0"}};
    root["licenses"] = Json::array();
    Json categories = Json::array();
    for (int nyu40 = 1; nyu40 <= kNyu40Count; ++nyu40) {
        categories.push_back(
            {{"id", nyu40}, {"name", nyu40Name(nyu40)}, {"supercategory", superCategory(nyu40)}});
    }
    Json images = Json::array();
    Json annotations = Json::array();
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const int index = static_cast<int>(i);
        images.push_back({{"id", index + 1},
                          {"file_name", contents.pictureFile(index)},
                          {"width", width},
                          {"height", height}});
        for (const ObjectMask& mask : contents.frames[i].masks) {
            const Object& object = scene.object(mask.object_id);
            if (object.role != Role::Target || mask.area == 0) continue;
            annotations.push_back(
                {{"id", annotations.size() + 1},
                 {"image_id", index + 1},
                 {"category_id", object.nyu40 == kNyuUnknown ? kNyuOtherProp : object.nyu40},
                 {"iscrowd", 0},
                 {"area", mask.area},
                 {"bbox", mask.bbox},
                 {"segmentation",
                  {{"size", {height, width}}, {"counts", compressCounts(mask.counts)}}},
                 {"object_id", object.id}});
        }
    }
    root["categories"] = std::move(categories);
    root["images"] = std::move(images);
    root["annotations"] = std::move(annotations);
    // Names from a scene file may hold anything; invalid UTF-8 must not end the export.
    return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dollytrack::render
