#pragma once

#include "engine/camera/sensor_params.h"
#include "engine/core/result.h"
#include "render/dataset/contents/frame_context.h"
#include "render/draw/scene_renderer.h"
#include "render/frames/frame_record.h"
#include "render/pipeline/traced_pictures.h"
#include "render/scene/object_paths.h"
#include "render/sensors/exposure.h"
#include "render/sensors/sensor_lens.h"

#include <optional>
#include <vector>

namespace dollytrack::render {

/// Focus distance of a frame, m: the configured one, else the median depth of the targets in the
/// image's central half (in width and height), else of everything there; none if nothing is visible
/// there.
[[nodiscard]] std::optional<double> focusDepthOf(const SensorParams& params, const Scene& scene,
                                                 const FrameRecord& frame);

/// Whether the focus depends on the frame's depth.
[[nodiscard]] inline bool focusesByDepth(const SensorParams& params) {
    return params.aperture_mm > 0.0 && params.focus_m <= 0.0;
}

/// Draws the light that reaches the sensor's lens: the mean of exposure samples over shutter and
/// aperture. Points at the focus distance must stay in place, so the image from aperture point (x,
/// y) is shifted by focal length * (x, y) / focus. This is a thin lens whose circle of confusion is
/// aperture * focal length in px * |1 / depth - 1 / focus|.
class SensorPictures {
  public:
    /// `objects` are the moving objects of the whole trajectory. `context` and `objects` must
    /// outlive this object. Returns Usage if the driver cannot draw an image of this size.
    static Result<SensorPictures> create(const FrameContext& context, const ObjectPaths& objects,
                                         Reflections reflections);

    /// Fills `light` with linear light of the pinhole image SensorLens::drawn(), 3 values per
    /// pixel. Path-traces it if `traced` is given. `frame` needs depth and ids if
    /// focusesByDepth(). Moving objects stay at the positions of the last sample.
    [[nodiscard]] Status take(const FrameRecord& frame, SceneRenderer& renderer,
                              TracedPictures* traced, std::vector<float>& light);

  private:
    SensorPictures(const FrameContext& context, const ObjectPaths& objects, Reflections reflections)
        : context_(context), objects_(objects), reflections_(reflections) {}
    [[nodiscard]] View viewOf(const ExposureSample& sample, const FrameRecord& frame,
                              std::optional<double> focus) const;
    [[nodiscard]] Status trace(const FrameRecord& frame, const Exposure& exposure,
                               std::optional<double> focus, TracedPictures& traced,
                               std::vector<float>& light) const;

    const FrameContext& context_;
    const ObjectPaths& objects_;
    Reflections reflections_;
    std::optional<RenderTarget> target_;
};

}  // namespace dollytrack::render
