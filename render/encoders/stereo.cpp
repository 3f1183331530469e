#include "engine/camera/intrinsics.h"
#include "engine/io/files/png_writer.h"
#include "render/encoders/encoders.h"
#include "render/encoders/pack.h"
#include "render/truth/motion_field.h"
#include "render/view/view.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

/// KITTI disparity: 256 steps per pixel; 0 for no surface and beyond the range.
std::vector<std::uint16_t> disparities(const FrameRecord& frame, double focal_times_baseline) {
    std::vector<std::uint16_t> result(frame.depth_m.size(), 0);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const auto depth = static_cast<double>(frame.depth_m[i]);
        if (!(depth > 0.0)) continue;
        const double steps = std::round(256.0 * focal_times_baseline / depth);
        if (steps >= 1.0 && steps <= 65535.0) result[i] = static_cast<std::uint16_t>(steps);
    }
    return result;
}

}  // namespace

FrameFiles encodeRgbRight(const FrameContext& /*context*/, const FrameRecord& frame) {
    return oneFile(frameFile("rgb_right", frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Rgb8, frame.rgb_right));
}

FrameFiles encodeDepthRight(const FrameContext& /*context*/, const FrameRecord& frame) {
    return oneFile(frameFile("depth_right", frame.index),
                   encodePng(frame.width, frame.height, PngFormat::Gray16,
                             bytesOf(depthInMillimetres(frame.depth_right_m))));
}

FrameFiles encodeDisparity(const FrameContext& context, const FrameRecord& frame) {
    const Intrinsics lens = makeIntrinsics(context.contents.camera);
    const double baseline = context.contents.stereo_baseline_m;
    FrameFiles files = oneFile(frameFile("disparity", frame.index),
                               encodePng(frame.width, frame.height, PngFormat::Gray16,
                                         bytesOf(disparities(frame, lens.fx * baseline))));
    if (!files) return files;
    const MotionField field = parallaxField(context, frame, rightOf(frame.pose, baseline));
    FrameFiles mask =
        oneFile(frameFile("disparity", frame.index, "_mask.png"),
                encodePng(frame.width, frame.height, PngFormat::Gray8, bytesOf(field.sight)));
    if (!mask) return mask;
    files->push_back(std::move(mask->front()));
    return files;
}

Json rgbRightConvention(const DatasetContents& contents) {
    return {
        {"folder", "rgb_right"},
        {"type", "uint8 x 3"},
        {"encoding", "sRGB"},
        {"baseline_m", contents.stereo_baseline_m},
        {"meaning", "a second camera like that of rgb, shifted by the baseline along its x axis"}};
}

Json depthRightConvention(const DatasetContents& contents) {
    Json convention = depthConvention(contents);
    convention["folder"] = "depth_right";
    convention["baseline_m"] = contents.stereo_baseline_m;
    return convention;
}

Json disparityConvention(const DatasetContents& contents) {
    return {{"folder", "disparity"},
            {"type", "uint16"},
            {"scale_px", 1.0 / 256.0},
            {"invalid", 0},
            {"baseline_m", contents.stereo_baseline_m},
            {"mask", {{"seen", 0}, {"occluded", 1}, {"outside", 2}, {"nothing", 255}}},
            {"meaning",
             "x in the left image minus x in the right image; also 0 for 256 px or more; "
             "NNNNNN_mask.png: visibility of the pixel's surface in the right image"}};
}

}  // namespace dollytrack::render
