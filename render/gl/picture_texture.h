#pragma once

#include "render/gl/handle.h"

#include <cstdint>
#include <span>

namespace dollytrack::gl {

/// A picture to be shown in a window: 8-bit RGBA, row 0 at the top, filtered when it is scaled.
class PictureTexture {
  public:
    /// Replaces the picture; 4 bytes a pixel.
    void upload(int width, int height, std::span<const std::uint8_t> rgba);
    void reset() { texture_.reset(); }

    [[nodiscard]] unsigned get() const { return texture_.get(); }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

  private:
    Texture texture_;
    int width_ = 0;
    int height_ = 0;
};

/// Makes the window itself what is drawn into, all of it in one colour.
void clearWindow(int width, int height, float red, float green, float blue);

}  // namespace dollytrack::gl
