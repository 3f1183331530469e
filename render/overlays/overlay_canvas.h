#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// The image that overlays are drawn into, over a copy of a rendered image. Row 0 is the top.
class OverlayCanvas {
  public:
    /// Creates the images. Returns Usage if the driver does not support the size.
    [[nodiscard]] static Result<OverlayCanvas> create(int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Both wait for the drawing and copy it: sRGB, 4 or 3 bytes per pixel.
    void readRgba(std::vector<std::uint8_t>& rgba) const;
    void readRgb(std::vector<std::uint8_t>& rgb) const;

  private:
    friend class OverlayRenderer;

    int width_ = 0;
    int height_ = 0;
    gl::Texture picture_;
    gl::Framebuffer frame_;
    // The frontmost boxes and triangles of one layer, before they are blended over the image.
    gl::Texture surface_color_;
    gl::Texture surface_z_;
    gl::Framebuffer surface_frame_;
};

}  // namespace dollytrack::render
