#pragma once

#include "engine/camera/lens_model.h"
#include "engine/camera/picture_params.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/dataset/contents/frame_context.h"
#include "render/frames/picture_layers.h"
#include "render/light/frame_lights.h"
#include "render/pathtrace/path_tracer.h"
#include "render/view/view.h"

#include <memory>
#include <vector>

namespace dollytrack::render {

/// Path-traced images of a dataset's frames, as an alternative to drawn ones: denoised with
/// RenderMode::Traced, else the plain mean of their samples.
class TracedPictures {
  public:
    /// `context` and `lights` must outlive this object; `job` can cancel the tracing.
    TracedPictures(const FrameContext& context, const FrameLights& lights,
                   const PictureParams& params, JobContext job);

    /// Traces a view with the objects and light of a frame. Returns Cancelled if the job was
    /// cancelled.
    [[nodiscard]] Result<PictureLayers> take(const View& view, int frame);
    /// The same for any lens; black outside its image circle.
    [[nodiscard]] Result<PictureLayers> take(const LensModel& lens, const Pose& pose, int frame);

    /// Traces exposure sample `number` of `parts` with 1 / `parts` of an image's paths per pixel,
    /// at least one, or two if they are denoised. Exposure samples have independent random numbers.
    [[nodiscard]] Result<PictureLayers> takePart(const View& view, int frame, int number,
                                                 int parts);

  private:
    struct Still;  // scene, light and tracer at one time
    [[nodiscard]] const PathTracer& tracerAt(int frame);
    [[nodiscard]] float exposureAt(int frame) const;
    [[nodiscard]] PathTracer::Picture pictureAt(int frame) const;
    [[nodiscard]] Result<PictureLayers> take(const View& view, int frame, int first_sample,
                                             int samples);

    const FrameContext& context_;
    const FrameLights& lights_;
    bool denoises_;
    int samples_;
    JobContext job_;
    int prepared_frame_ = -1;
    std::shared_ptr<Still> still_;
};

}  // namespace dollytrack::render
