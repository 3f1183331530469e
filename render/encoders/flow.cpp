#include "engine/io/files/png_writer.h"
#include "render/encoders/encoders.h"
#include "render/encoders/exr.h"
#include "render/encoders/pack.h"
#include "render/truth/motion_field.h"

#include <nlohmann/json.hpp>

#include <bit>
#include <cstring>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "Middlebury's files are little-endian");

static_assert(sizeof(Eigen::Vector2f) == 8);

/// Middlebury .flo file: "PIEH", width, height, then u and v of each pixel.
std::vector<std::uint8_t> middlebury(int width, int height, const MotionField& field) {
    std::vector<std::uint8_t> bytes(12 + 8 * field.motion.size());
    std::memcpy(bytes.data(), "PIEH", 4);
    std::memcpy(bytes.data() + 4, &width, 4);
    std::memcpy(bytes.data() + 8, &height, 4);
    std::memcpy(bytes.data() + 12, field.motion.data(), 8 * field.motion.size());
    return bytes;
}

FrameFiles encodeFlow(const FrameContext& context, const FrameRecord& frame, const char* folder,
                      int direction) {
    std::vector<FrameFile> files;
    for (const int distance : context.contents.flow_distances) {
        const int other = frame.index + direction * distance;
        if (other < 0 || other >= static_cast<int>(context.contents.frames.size())) continue;
        const MotionField field = motionField(context, frame, other);
        files.push_back({pairFile(folder, frame.index, other, ".flo"),
                         middlebury(frame.width, frame.height, field)});
        auto mask = encodePng(frame.width, frame.height, PngFormat::Gray8, bytesOf(field.sight));
        if (!mask) return tl::unexpected(std::move(mask.error()));
        files.push_back({pairFile(folder, frame.index, other, "_mask.png"), std::move(*mask)});
    }
    return files;
}

Json flowConvention(const DatasetContents& contents, const char* folder, const char* to) {
    return {{"folder", folder},
            {"files", "AAAAAA_BBBBBB.flo and AAAAAA_BBBBBB_mask.png: from frame A to frame B"},
            {"type", "Middlebury .flo: float32 u (right), v (down), px"},
            {"distances", contents.flow_distances},
            {"to", to},
            {"invalid", kNoMotion},
            {"mask", {{"seen", 0}, {"occluded", 1}, {"outside", 2}, {"nothing", 255}}},
            {"meaning",
             "motion from A to B, of camera and objects, of the surface point at the pixel's "
             "centre; invalid where no surface is visible, and where the point is behind B's "
             "camera or nearer than near_m"}};
}

}  // namespace

FrameFiles encodeFlowForward(const FrameContext& context, const FrameRecord& frame) {
    return encodeFlow(context, frame, "flow_forward", 1);
}

FrameFiles encodeFlowBackward(const FrameContext& context, const FrameRecord& frame) {
    return encodeFlow(context, frame, "flow_backward", -1);
}

FrameFiles encodeSceneFlow(const FrameContext& context, const FrameRecord& frame) {
    std::vector<FrameFile> files;
    for (const int distance : context.contents.flow_distances) {
        const int other = frame.index + distance;
        if (other >= static_cast<int>(context.contents.frames.size())) continue;
        auto bytes = encodeExrVectors(frame.width, frame.height, sceneFlow(context, frame, other));
        if (!bytes) return tl::unexpected(std::move(bytes.error()));
        files.push_back({pairFile("scene_flow", frame.index, other, ".exr"), std::move(*bytes)});
    }
    return files;
}

Json sceneFlowConvention(const DatasetContents& contents) {
    return {{"folder", "scene_flow"},
            {"files", "AAAAAA_BBBBBB.exr: from frame A to frame B"},
            {"type", "OpenEXR, 32-bit float, m: R right, G down, B forward"},
            {"distances", contents.flow_distances},
            {"to", "B = A + distance"},
            {"invalid", kNoMotion},
            {"meaning",
             "position in B's camera axes minus position in A's, of the surface point at the "
             "pixel's centre; invalid where no surface is visible"}};
}

Json flowForwardConvention(const DatasetContents& contents) {
    return flowConvention(contents, "flow_forward", "B = A + distance");
}

Json flowBackwardConvention(const DatasetContents& contents) {
    return flowConvention(contents, "flow_backward", "B = A - distance");
}

}  // namespace dollytrack::render
