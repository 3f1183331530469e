#include "engine/io/files/png_writer.h"
#include "render/encoders/encoders.h"
#include "render/encoders/exr.h"
#include "render/encoders/pack.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

FrameFiles encodeRgb(const FrameContext& /*context*/, const FrameRecord& frame) {
    return oneFile(frameFile("rgb", frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Rgb8, frame.rgb));
}

FrameFiles encodeDepth(const FrameContext& /*context*/, const FrameRecord& frame) {
    return oneFile(frameFile("depth", frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Gray16,
                             bytesOf(depthInMillimetres(frame.depth_m))));
}

FrameFiles encodeDepthExr(const FrameContext& /*context*/, const FrameRecord& frame) {
    return oneFile(frameFile("depth_exr", frame.index, ".exr"),
                   encodeExr(frame.width, frame.height, frame.depth_m));
}

FrameFiles encodeInstance(const FrameContext& /*context*/, const FrameRecord& frame) {
    return oneFile(
        frameFile("instance", frame.index),
        encodePng(frame.width, frame.height, PngFormat::Gray16, bytesOf(frame.instance)));
}

FrameFiles encodeSemantic(const FrameContext& context, const FrameRecord& frame) {
    const Scene& scene = context.contents.scene;
    return oneFile(frameFile("semantic", frame.index),
                   encodePng(frame.width, frame.height, classFormat(scene.classes()),
                             classBytes(scene.classes(), classesOf(scene, frame.instance))));
}

Json rgbConvention(const DatasetContents& /*contents*/) {
    return {{"folder", "rgb"}, {"type", "uint8 x 3"}, {"encoding", "sRGB"}};
}

Json depthConvention(const DatasetContents& /*contents*/) {
    return {{"folder", "depth"},
            {"type", "uint16"},
            {"kind", "planar"},
            {"scale_m", 0.001},
            {"invalid", 0},
            {"max_m", 65.535},
            {"meaning", "distance along the viewing axis, not along the ray"}};
}

Json depthExrConvention(const DatasetContents& /*contents*/) {
    return {
        {"folder", "depth_exr"}, {"type", "float32, channel Y"},
        {"kind", "planar"},      {"scale_m", 1.0},
        {"invalid", 0},          {"meaning", "distance along the viewing axis, not along the ray"}};
}

Json instanceConvention(const DatasetContents& /*contents*/) {
    return {
        {"folder", "instance"}, {"type", "uint16"}, {"invalid", 0}, {"meaning", "objects[].id"}};
}

Json semanticConvention(const DatasetContents& contents) {
    const ClassTable& table = contents.scene.classes();
    return {{"folder", "semantic"},
            {"type", table.isWide() ? "uint16" : "uint8"},
            {"invalid", table.voidClass().id},
            {"meaning", table.isNyu40() ? "NYU40 class" : "classes[].id"}};
}

}  // namespace dollytrack::render
