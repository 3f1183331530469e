#pragma once

#include "engine/camera/picture_params.h"
#include "render/frames/frame_context.h"
#include "render/light/frame_lights.h"
#include "render/light/traced_reflections.h"

#include <array>
#include <memory>

namespace dollytrack::render {

/// What smooth surfaces show in the drawn pictures of a dataset's frames. Sensor pictures show in
/// mirrors what moves where it is at the frame's time, without the blur of its motion.
class FrameReflections {
  public:
    /// `context` and `lights` must outlive this.
    FrameReflections(const FrameContext& context, const FrameLights& lights, Reflections which);

    /// With things and light as they are in the frame, until the next call but one; null where
    /// nothing in the scene reflects.
    [[nodiscard]] const TracedReflections* at(int frame);

  private:
    struct Still;  // a scene at one time

    const FrameContext& context_;
    const FrameLights& lights_;
    bool any_;
    // Of even and of odd frames: some pictures of a frame are drawn when the next has begun.
    std::array<std::shared_ptr<Still>, 2> stills_;
};

}  // namespace dollytrack::render
