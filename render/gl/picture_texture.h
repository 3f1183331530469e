#pragma once

#include "render/gl/handle.h"

#include <cstdint>
#include <span>

namespace dollytrack::gl {

/// An 8-bit RGBA image as a linearly filtered texture, for display in a window. Row 0 is the top.
class PictureTexture {
  public:
    /// Replaces the image. `rgba` holds 4 bytes per pixel.
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

/// Binds the window's framebuffer, sets its viewport and clears it to one colour.
void clearWindow(int width, int height, float red, float green, float blue);

}  // namespace dollytrack::gl
