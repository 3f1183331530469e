#pragma once

#include "engine/camera/picture_params.h"
#include "render/dataset/contents/frame_context.h"
#include "render/light/frame_lights.h"
#include "render/light/traced_reflections.h"

#include <array>
#include <memory>

namespace dollytrack::render {

/// Traced reflections for the frames of a dataset. Moving objects are mirrored at the frame's time,
/// without motion blur.
class FrameReflections {
  public:
    /// `context` and `lights` must outlive this object.
    FrameReflections(const FrameContext& context, const FrameLights& lights, Reflections which);

    /// Reflections with the objects and light of this frame, valid until the second next call. Null
    /// if nothing in the scene reflects.
    [[nodiscard]] const TracedReflections* at(int frame);

  private:
    struct Still;  // scene, light and reflections at one time

    const FrameContext& context_;
    const FrameLights& lights_;
    bool any_;
    // One slot for even and one for odd frames, because a frame may still be drawn when the next
    // begins.
    std::array<std::shared_ptr<Still>, 2> stills_;
};

}  // namespace dollytrack::render
