#pragma once

#include "engine/camera/sensor_params.h"
#include "engine/core/result.h"
#include "render/draw/scene_renderer.h"
#include "render/frames/frame_context.h"
#include "render/frames/frame_record.h"
#include "render/pathtrace/reference_pictures.h"
#include "render/sensors/exposure.h"
#include "render/sensors/object_paths.h"
#include "render/sensors/sensor_lens.h"

#include <optional>
#include <vector>

namespace dollytrack::render {

/// The depth that a frame is focused on, m: as set, else the median of the targets in the middle
/// half (by width and by height) of the frame, else of all that is there; `none` where that shows
/// nothing.
[[nodiscard]] std::optional<double> focusDepthOf(const SensorParams& params, const Scene& scene,
                                                 const FrameRecord& frame);

/// Whether that takes the frame's depth.
[[nodiscard]] inline bool focusesByDepth(const SensorParams& params) {
    return params.aperture_mm > 0.0 && params.focus_m <= 0.0;
}

/// Takes the light of a frame as it falls into the sensor's lens: the mean of looks over shutter
/// and aperture. A lens point (x, y) sees what lies in focus at the same place, so the picture from
/// there is shifted by focal length times (x, y) / focus: a thin lens, whose circle of confusion is
/// aperture * focal length in px * |1 / depth - 1 / focus|.
class SensorPictures {
  public:
    /// `objects`: what moves while a picture is taken, over the whole trajectory. Both must outlive
    /// this.
    static Result<SensorPictures> create(const FrameContext& context, const ObjectPaths& objects,
                                         Reflections reflections);

    /// Fills `light` with linear light through the pinhole SensorLens::drawn(), 3 values a pixel.
    /// By `reference` where there is one. `frame` has depth and ids, if the focus depends on it.
    /// Leaves things that move where they were last.
    [[nodiscard]] Status take(const FrameRecord& frame, SceneRenderer& renderer,
                              ReferencePictures* reference, std::vector<float>& light);

  private:
    SensorPictures(const FrameContext& context, const ObjectPaths& objects, Reflections reflections)
        : context_(context), objects_(objects), reflections_(reflections) {}
    [[nodiscard]] View viewOf(const ExposureLook& look, const FrameRecord& frame,
                              std::optional<double> focus) const;
    [[nodiscard]] Status trace(const FrameRecord& frame, const Exposure& exposure,
                               std::optional<double> focus, ReferencePictures& reference,
                               std::vector<float>& light) const;

    const FrameContext& context_;
    const ObjectPaths& objects_;
    Reflections reflections_;
    std::optional<RenderTarget> target_;
};

}  // namespace dollytrack::render
