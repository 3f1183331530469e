#pragma once

#include "engine/camera/lens_model.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/draw/view.h"
#include "render/frames/frame_context.h"
#include "render/light/frame_lights.h"
#include "render/pathtrace/path_tracer.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::render {

/// Path traced pictures of a dataset's frames, in place of drawn ones.
class ReferencePictures {
  public:
    /// `context` and `lights` must outlive this; the job can cancel.
    ReferencePictures(const FrameContext& context, const FrameLights& lights, int samples,
                      JobContext job);

    /// The view with things where they are in the frame, 3 bytes a pixel, sRGB. Error: Cancelled.
    [[nodiscard]] Status take(const View& view, int frame, std::vector<std::uint8_t>& rgb);

    /// One of several looks that together have the samples of a picture (one each at least): the
    /// light before the tone curve, 1 is white. Each number has random numbers of its own.
    [[nodiscard]] Status takePart(const View& view, int frame, int number, int parts,
                                  std::vector<Eigen::Vector3f>& light);
    /// The same through any lens; black outside of its image circle.
    [[nodiscard]] Status take(const LensModel& lens, const Pose& pose, int frame,
                              std::vector<std::uint8_t>& rgb);

  private:
    struct Still;  // a scene at one time, ready to be traced
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
