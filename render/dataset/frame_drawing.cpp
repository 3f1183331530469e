#include "render/dataset/frame_drawing.h"

#include "engine/core/log.h"
#include "engine/plan/frame_series.h"
#include "engine/scene/varied_materials.h"
#include "render/formats/poses/calibration.h"
#include "render/rig/rig_clearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace dollytrack::render {
namespace {

/// Warns of moving objects near the camera; the plan avoids them at one time only.
void warnOfTouching(const DatasetContents& contents) {
    const double radius = contents.camera.camera_radius_m;
    const auto first = std::ranges::find_if(
        contents.frames, [&](const DatasetFrame& frame) { return frame.clearance_m < radius; });
    if (first == contents.frames.end()) return;
    const auto count = std::ranges::count_if(
        contents.frames, [&](const DatasetFrame& frame) { return frame.clearance_m < radius; });
    log::warn("export", "moving objects are closer to the camera than camera_radius_m in " +
                            std::to_string(count) + " frames, first in frame " +
                            std::to_string(first->source_frame) +
                            "; plan with them at other poses (--time), or export with --still");
}

/// Warns that labels belong to the undistorted images.
void warnOfBentOutlines(const SensorLens& lens, const FormatSet& formats) {
    std::string names;
    for (const Format* format : formats) {
        if (format->outlines_things)
            names += (names.empty() ? "" : ", ") + std::string(format->name);
    }
    if (names.empty() || lens.largestShift_px() < 0.05) return;
    log::warn("export", fmt::format("boxes and masks of {} fit the clean images (rgb); the lens "
                                    "distortion of rgb_sensor displaces objects by up to {:.1f} px",
                                    names, lens.largestShift_px()));
}

/// Warns that path tracing does not blur moving objects.
void warnOfUnblurred(const DatasetSettings& settings, const DatasetOrigin& origin) {
    const bool lasts = settings.sensor.shutter_s > 0.0 || settings.sensor.readout_s > 0.0;
    if (settings.picture.render_mode == RenderMode::Fast || origin.motions.empty() || !lasts) {
        return;
    }
    log::warn("export",
              "path-traced images have no motion blur of moving objects; render_mode=fast has it");
}

}  // namespace

std::unique_ptr<const Scene> FrameDrawing::variedScene(const Scene& scene,
                                                       const LightParams& light) {
    if (light.light_variation <= 0.0) return nullptr;
    auto varied = std::make_unique<Scene>(scene);
    varyMaterials(*varied, light);
    return varied;
}

FrameDrawing::~FrameDrawing() {
    // Another context may be current by now; its objects must not be deleted.
    if (context && !context->makeCurrent())
        log::error("export", "the OpenGL context no longer exists");
}

unsigned FrameDrawing::needs() const {
    unsigned all = 0;
    for (const Modality* modality : order.contents.modalities) all |= modality->needs;
    for (const Format* format : order.card.formats) all |= format->needs;
    return all;
}

Status FrameDrawing::prepare(const RayCaster& rays, const Trajectory& trajectory,
                             const DatasetOrigin& origin,
                             std::map<int, std::vector<ObjectView>> restored,
                             const JobContext& job) {
    DatasetContents& contents = order.contents;
    moving.emplace(contents.scene, rays, contents.motions);
    frame_context.emplace(FrameContext{contents, *moving});
    if (contains(contents.modalities, kRgbSensor)) {
        object_paths.emplace(contents.scene, trajectory, origin.motions);
        frame_context->sensor_lens = &sensor_lens.emplace(contents.camera, contents.sensor);
        warnOfBentOutlines(*sensor_lens, order.card.formats);
        warnOfUnblurred(settings, origin);
    }
    for (std::size_t i = 0; i < contents.frames.size(); ++i) {
        DatasetFrame& frame = contents.frames[i];
        frame.clearance_m =
            clearanceAt(*moving->raysAt(static_cast<int>(i)), frame.camera.pose.position);
    }
    if (moving->any()) warnOfTouching(contents);
    for (const std::string& warning : rigWarnings(*frame_context)) log::warn("export", warning);
    pipeline.emplace(*frame_context, settings.rules, needs(), settings.picture,
                     std::move(restored));
    return pipeline->prepare(rays, origin.rooms, object_paths ? &*object_paths : nullptr,
                             job.stage(0.3, 1.0, "light"));
}

Result<FrameSeries> FrameSeries::begin(std::unique_ptr<gl::Context> context, const Scene& given,
                                       const RayCaster& rays, const Trajectory& trajectory,
                                       const CameraParams& camera, DatasetSettings settings,
                                       DatasetOrigin origin, const JobContext& job) {
    settings.formats = {kCalibrationFormat.name};  // any format without needs; it is removed below
    std::unique_ptr<const Scene> varied = FrameDrawing::variedScene(given, settings.light);
    Result<DatasetOrder> order =
        describeOrder(varied ? *varied : given, camera, trajectory, settings, origin);
    if (!order) return tl::unexpected(order.error());
    order->card.formats.clear();
    auto drawing =
        std::make_unique<FrameDrawing>(std::move(settings), std::move(varied), std::move(*order));
    drawing->context = std::move(context);
    if (Status status = drawing->prepare(rays, trajectory, origin, {}, job); !status) {
        return tl::unexpected(status.error());
    }
    return FrameSeries(std::move(drawing));
}

Result<std::optional<FrameRecord>> FrameSeries::next() {
    FramePipeline& pipeline = *drawing_->pipeline;
    std::optional<FrameRecord> drawn;
    if (pipeline.doneCount() == pipeline.frameCount()) return drawn;
    Status status = drawing_->context->makeCurrent();
    if (status) {
        status = pipeline.drawNext(
            [&](FrameRecord frame) -> Status {
                frame.labelClasses(contents().scene);
                drawn = std::move(frame);
                return {};
            },
            nullptr);
    }
    if (!status) return tl::unexpected(status.error());
    return drawn;
}

}  // namespace dollytrack::render
