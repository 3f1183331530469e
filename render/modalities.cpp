#include "render/modalities.h"

#include "engine/io/png_writer.h"
#include "render/choice.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = Result<std::vector<std::uint8_t>>;

std::span<const std::uint8_t> bytesOf(const std::vector<std::uint16_t>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), 2 * values.size()};
}

Bytes encodeRgb(const Scene& /*scene*/, const FrameRecord& frame) {
    return io::encodePng(frame.width, frame.height, io::PngFormat::Rgb8, frame.rgb);
}

Bytes encodeDepth(const Scene& /*scene*/, const FrameRecord& frame) {
    return io::encodePng(frame.width, frame.height, io::PngFormat::Gray16,
                         bytesOf(depthInMillimetres(frame.depth_m)));
}

Bytes encodeInstance(const Scene& /*scene*/, const FrameRecord& frame) {
    return io::encodePng(frame.width, frame.height, io::PngFormat::Gray16, bytesOf(frame.instance));
}

Bytes encodeSemantic(const Scene& scene, const FrameRecord& frame) {
    return io::encodePng(frame.width, frame.height, io::PngFormat::Gray8,
                         classesOf(scene, frame.instance));
}

Json rgbConvention() {
    return {{"folder", "rgb"}, {"type", "uint8 x 3"}, {"encoding", "sRGB"}};
}

Json depthConvention() {
    return {{"folder", "depth"},
            {"type", "uint16"},
            {"kind", "planar"},
            {"scale_m", 0.001},
            {"invalid", 0},
            {"max_m", 65.535},
            {"meaning", "distance along the viewing axis, not along the ray"}};
}

Json instanceConvention() {
    return {
        {"folder", "instance"}, {"type", "uint16"}, {"invalid", 0}, {"meaning", "objects[].id"}};
}

Json semanticConvention() {
    return {{"folder", "semantic"}, {"type", "uint8"}, {"invalid", 0}, {"meaning", "NYU40 class"}};
}

// Bytes a pixel: measured over real rooms at 640 x 480, see README.md.
constexpr std::array<Modality, 4> kModalities = {{
    {"rgb", "8-bit colour pictures", 1.2, encodeRgb, rgbConvention},
    {"depth", "16-bit depth along the viewing axis, in millimetres", 0.3, encodeDepth,
     depthConvention},
    {"instance", "16-bit object ids, walls and floors included", 0.06, encodeInstance,
     instanceConvention},
    {"semantic", "8-bit NYU40 classes", 0.04, encodeSemantic, semanticConvention},
}};

}  // namespace

std::span<const Modality> modalities() {
    return kModalities;
}

Result<ModalitySet> chooseModalities(const std::vector<std::string>& names) {
    return chooseRows(modalities(), names, "modality", "--modalities");
}

bool contains(const ModalitySet& set, std::string_view name) {
    return std::any_of(set.begin(), set.end(), [&](const Modality* m) { return m->name == name; });
}

std::string frameFile(const std::string& modality, int index) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "/%06d.png", index);
    return modality + name.data();
}

}  // namespace dollytrack::render
