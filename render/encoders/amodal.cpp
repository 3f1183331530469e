#include "render/encoders/encoders.h"
#include "render/frames/mask_rle.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {

using Json = nlohmann::ordered_json;

FrameFiles encodeAmodal(const FrameContext& /*context*/, const FrameRecord& frame) {
    Json objects = Json::array();
    std::vector<std::uint16_t> image(frame.instance.size());
    for (const RenderedAmodalMask& whole : frame.whole) {
        const auto id = static_cast<std::uint16_t>(whole.object_id);
        for (std::size_t i = 0; i < image.size(); ++i) image[i] = frame.instance[i] == id ? id : 0;
        for (int y = 0; y < whole.height; ++y) {
            for (int x = 0; x < whole.width; ++x) {
                if (!whole.covers(whole.x0 + x, whole.y0 + y)) continue;
                image[static_cast<std::size_t>(whole.y0 + y) *
                          static_cast<std::size_t>(frame.width) +
                      static_cast<std::size_t>(whole.x0 + x)] = id;
            }
        }
        for (const ObjectMask& mask : objectMasks(frame.width, frame.height, image)) {
            objects.push_back({{"object_id", mask.object_id},
                               {"bbox", mask.bbox},
                               {"size", {frame.height, frame.width}},
                               {"counts", compressCounts(mask.counts)}});
        }
    }
    const std::string text = Json{{"objects", std::move(objects)}}.dump() + "\n";
    std::vector<FrameFile> files;
    files.push_back({frameFile("amodal", frame.index, ".json"), {text.begin(), text.end()}});
    return files;
}

Json amodalConvention(const DatasetContents& /*contents*/) {
    return {{"folder", "amodal"},
            {"type", "JSON: compressed run lengths (COCO) by object"},
            {"meaning",
             "amodal masks: the pixels that each visible object would cover if nothing occluded "
             "it; walls, floors and other structure have none"}};
}

}  // namespace dollytrack::render
