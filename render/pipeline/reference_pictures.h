#pragma once

#include "engine/camera/lens_model.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/dataset/contents/frame_context.h"
#include "render/light/frame_lights.h"
#include "render/pathtrace/path_tracer.h"
#include "render/view/view.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::render {

/// Path-traced images of a dataset's frames, as an alternative to drawn ones.
class ReferencePictures {
  public:
    /// `context` and `lights` must outlive this object; `job` can cancel the tracing.
    ReferencePictures(const FrameContext& context, const FrameLights& lights, int samples,
                      JobContext job);

    /// Traces a view with the objects and light of a frame: sRGB, 3 bytes per pixel. Returns
    /// Cancelled if the job was cancelled.
    [[nodiscard]] Status take(const View& view, int frame, std::vector<std::uint8_t>& rgb);

    /// Traces exposure sample `number` with a share 1 / `parts` of an image's samples, at least
    /// one. `light` is linear, before the tone curve, 1 is white. Each number uses its own random
    /// numbers.
    [[nodiscard]] Status takePart(const View& view, int frame, int number, int parts,
                                  std::vector<Eigen::Vector3f>& light);
    /// The same for any lens; black outside its image circle.
    [[nodiscard]] Status take(const LensModel& lens, const Pose& pose, int frame,
                              std::vector<std::uint8_t>& rgb);

  private:
    struct Still;  // scene and tracer at one time
    [[nodiscard]] const PathTracer& tracerAt(int frame);
    [[nodiscard]] float exposureAt(int frame) const;

    const FrameContext& context_;
    const FrameLights& lights_;
    int samples_;
    JobContext job_;
    int prepared_frame_ = -1;
    std::shared_ptr<Still> still_;
};

}  // namespace dollytrack::render
