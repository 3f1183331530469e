#include "render/formats/tables/frames_csv.h"

#include "engine/scene/resolved_light.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <iterator>
#include <numbers>

namespace dollytrack::render {
namespace {

using Boxes = std::vector<Eigen::AlignedBox2d>;

/// Bounding boxes of the frame's targets, without those too small to count.
Boxes targetBoxes(const DatasetContents& contents, const DatasetFrame& frame) {
    const double image_px =
        static_cast<double>(contents.camera.width_px) * contents.camera.height_px;
    const double least_px = CaptureRules{}.min_visible_px * image_px / (640.0 * 480.0);
    Boxes boxes;
    for (const ObjectMask& mask : frame.masks) {
        if (contents.scene.object(mask.object_id).role != Role::Target) continue;
        if (mask.area < least_px) continue;
        const auto& [x, y, width, height] = mask.bbox;
        boxes.emplace_back(Eigen::Vector2d(x, y), Eigen::Vector2d(x + width, y + height));
    }
    return boxes;
}

/// "speed,turn," since the previous frame; empty values at the start of a path.
std::string motionText(const TrajectoryFrame* before, const TrajectoryFrame& frame) {
    if (before == nullptr || before->path != frame.path) return ",,";
    const double seconds = frame.time_s - before->time_s;
    if (seconds <= 0.0) return ",,";
    const double step = (frame.pose.position - before->pose.position).norm();
    const double turn = angleBetween(frame.pose.rotation, before->pose.rotation);
    return fmt::format("{:.6g},{:.6g},", step / seconds, turn * 180.0 / std::numbers::pi / seconds);
}

constexpr const char* kLightColumns =
    ",lamp_strength,lamp_temperature_K,sky_strength,sun_strength,exposure_ev";

std::string lightText(const LightParams& light, int trajectory_frame) {
    const LightParams drawn = resolvedAt(light, trajectory_frame).drawn;
    return fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", drawn.lamp_strength,
                       drawn.lamp_temperature_K, drawn.sky_strength, drawn.sun_strength,
                       drawn.exposure_ev);
}

std::string_view qualityText(const DatasetFrame& frame) {
    return frame.quality ? kPictureQualities[static_cast<std::size_t>(*frame.quality)] : "";
}

}  // namespace

std::string framesCsvText(const DatasetContents& contents) {
    Trajectory trajectory;
    std::vector<Boxes> boxes;
    for (const DatasetFrame& frame : contents.frames) {
        trajectory.frames.push_back(frame.camera);
        boxes.push_back(targetBoxes(contents, frame));
    }
    const std::vector<double> scores = imageScores(trajectory, boxes, contents.score);
    std::string text =
        "frame,time_s,trajectory_frame,room,path,key_frame,clearance_m,speed_mps,turn_dps,targets,"
        "well_shown,score,picture";
    const bool light_varies = variesByFrame(contents.light);
    text += light_varies ? fmt::format("{}\n", kLightColumns) : "\n";
    const TrajectoryFrame* before = nullptr;
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        const DatasetFrame& frame = contents.frames[i];
        const TrajectoryFrame& camera = frame.camera;
        fmt::format_to(
            std::back_inserter(text), "{},{:.9g},{},{},{},{},{:.6g},{}{},{},{:.6g},{}{}\n", i,
            camera.time_s, frame.source_frame, frame.room, camera.path,
            camera.position_point >= 0 ? 1 : 0, frame.clearance_m, motionText(before, camera),
            boxes[i].size(), frame.well_shown.size(), scores[i], qualityText(frame),
            light_varies ? lightText(contents.light, frame.source_frame) : "");
        before = &camera;
    }
    return text;
}

namespace {

constexpr std::array<const char*, 1> kFramesCsvFiles = {"frames.csv"};

Result<std::vector<DatasetFile>> writeFramesCsv(const DatasetContents& contents) {
    return std::vector<DatasetFile>{{kFramesCsvFiles[0], framesCsvText(contents)}};
}

nlohmann::ordered_json framesCsvConvention(const DatasetContents& /*contents*/) {
    return {{"file", kFramesCsvFiles[0]},
            {"format",
             "one row per frame: clearance (m), mean speed (m/s) and turning rate (deg/s) since "
             "the previous frame, number of targets of 120 px or more (at 640 x 480) and of well "
             "shown ones, image score of their boxes; with light_varies=frame also the light"}};
}

}  // namespace

const Format kFramesFormat = {
    .name = "frames",
    .text = "measurements of each frame, such as speed, clearance and image score, in frames.csv",
    .group = ContentGroup::Measurements,
    .standard = true,
    .needs = kNeedsMasks,
    .files = kFramesCsvFiles,
    .write = writeFramesCsv,
    .convention = framesCsvConvention,
};

}  // namespace dollytrack::render
