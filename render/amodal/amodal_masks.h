#pragma once

#include "engine/core/result.h"
#include "render/draw/gpu_scene.h"
#include "render/draw/view.h"
#include "render/gl/handle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Amodal mask: the pixels that an object would cover if nothing stood in front of it.
struct RenderedAmodalMask {
    int object_id = 0;
    int x0 = 0;  // px, rectangle of the image that contains the mask
    int y0 = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> inside;  // by pixel of the rectangle, row 0 at the top: 0 or 255

    [[nodiscard]] bool covers(int x, int y) const {
        return x >= x0 && y >= y0 && x < x0 + width && y < y0 + height &&
               inside[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x - x0)] != 0;
    }
};

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
