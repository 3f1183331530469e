#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/gpu_scene.h"
#include "render/frames/amodal_mask.h"
#include "render/gl/handle.h"
#include "render/view/view.h"

#include <span>
#include <vector>

namespace dollytrack::render {

/// Draws amodal masks, many side by side on one large texture. The pixel grid is that of the
/// image.
class AmodalMaskRenderer {
  public:
    [[nodiscard]] static Result<AmodalMaskRenderer> create();

    /// The masks of the objects whose bounding boxes reach into the image, in the order of the ids.
    /// Returns Failed on OpenGL errors, such as exhausted graphics memory.
    [[nodiscard]] Result<std::vector<RenderedAmodalMask>> draw(const GpuScene& scene,
                                                               const View& view,
                                                               std::span<const int> object_ids);

  private:
    gl::Program program_;
    gl::Texture sheet_;
    gl::Framebuffer frame_;
    int side_ = 0;  // of the texture, px
};

}  // namespace dollytrack::render
