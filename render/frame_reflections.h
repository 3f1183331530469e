#pragma once

#include "engine/camera/picture_params.h"
#include "render/frame_context.h"
#include "render/frame_lights.h"
#include "render/traced_reflections.h"

#include <memory>

namespace dollytrack::render {

/// What smooth surfaces show in the drawn pictures of a dataset's frames.
class FrameReflections {
  public:
    /// `context` and `lights` must outlive this.
    FrameReflections(const FrameContext& context, const FrameLights& lights, Reflections which);

    /// With things and light as they are in the frame, until the next call; null where nothing in
    /// the scene reflects.
    [[nodiscard]] const TracedReflections* at(int frame);

  private:
    struct Still;  // a scene at one time

    const FrameContext& context_;
    const FrameLights& lights_;
    bool any_;
    int prepared_frame_ = -1;
    std::shared_ptr<Still> still_;
};

}  // namespace dollytrack::render
