#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/frame_context.h"
#include "render/light_rig.h"
#include "render/pathtrace/path_tracer.h"
#include "render/view.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace dollytrack::render {

/// Path traced pictures of a dataset's frames, in place of drawn ones.
class ReferencePictures {
  public:
    /// `rig` and `exposure` as the drawn pictures have them, see balanced(). `context` must outlive
    /// this; the job can cancel.
    ReferencePictures(const FrameContext& context, LightRig rig, float exposure, int samples,
                      JobContext job);

    /// The view with things where they are in the frame, 3 bytes a pixel, sRGB. Error: Cancelled.
    [[nodiscard]] Status take(const View& view, int frame, std::vector<std::uint8_t>& rgb);

  private:
    struct Still;  // a scene at one time, ready to be traced
    [[nodiscard]] const PathTracer& tracerAt(int frame);

    const FrameContext& context_;
    LightRig rig_;
    float exposure_;
    int samples_;
    JobContext job_;
    int prepared_frame_ = -1;
    std::shared_ptr<Still> still_;
};

}  // namespace dollytrack::render
