#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// The images that one view is drawn into. Row 0 is the top.
class RenderTarget {
  public:
    [[nodiscard]] static Result<RenderTarget> create(int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Waits for the drawing and copies the finished image: sRGB, 3 bytes per pixel.
    void readRgb(std::vector<std::uint8_t>& rgb) const;
    /// Planar depth, m; 0 where nothing was hit.
    void readDepth(std::vector<float>& depth) const;
    /// Planar depth as rasterised, m. Zero, negative or non-finite values mark pixels of edge-on
    /// surfaces, where rasterised depth is unreliable; findCracks() casts rays for them.
    void readDrawnDepth(std::vector<float>& depth) const;
    /// Object ids; 0 where nothing was hit.
    void readIds(std::vector<std::uint16_t>& ids) const;

    /// The weighted mean accumulated by SceneRenderer::addLight(): linear light before the tone
    /// curve, 3 values per pixel; 0 where nothing was added. beginLight() must have been called.
    void readLight(std::vector<float>& light) const;

    /// The finished image as an OpenGL texture, for display in a window.
    [[nodiscard]] unsigned picture() const { return picture_.get(); }
    /// The depth of readDrawnDepth() as an OpenGL texture of 32-bit floats.
    [[nodiscard]] unsigned depth() const { return depth_.get(); }
    /// The depth buffer: 1 at the near plane, 0 at infinity or at the far end of an orthographic
    /// view.
    [[nodiscard]] unsigned zBuffer() const { return z_buffer_.get(); }

    /// Depth (m) and object id of one pixel, for picking; zeros outside the image. Waits for the
    /// drawing.
    struct Pixel {
        float depth_m = 0.0F;
        std::uint16_t object_id = 0;
    };
    [[nodiscard]] Pixel readPixel(int x, int y) const;

  private:
    friend class SceneRenderer;
    friend class SurfacePass;
    friend class SurfaceTarget;
    friend class LightPass;

    void makeSum();

    int width_ = 0;
    int height_ = 0;
    gl::Texture color_;    // rgb: square root of albedo; a: metallic or emission
    gl::Texture normal_;   // xyz: world normal; w: roughness
    gl::Texture surface_;  // planar depth of the shaded surface
    gl::Texture depth_;    // planar depth of the labelled surface
    gl::Texture ids_;
    gl::Texture z_buffer_;
    gl::Texture occlusion_;  // occlusion and planar depth; half resolution
    gl::Texture soft_occlusion_;
    gl::Texture lit_;
    gl::Texture sum_;    // accumulated linear light; created at first use
    gl::Texture marks_;  // depth buffer that marks pixels already shaded
    gl::Texture picture_;
    gl::Framebuffer surfaces_frame_;
    gl::Framebuffer shading_frame_;  // colour, normal and surface depth only
    gl::Framebuffer labels_frame_;   // label depth and ids only
    gl::Framebuffer occlusion_frame_;
    gl::Framebuffer soft_frame_;
    gl::Framebuffer lit_frame_;
    gl::Framebuffer sum_frame_;
    gl::Framebuffer picture_frame_;
};

}  // namespace dollytrack::render
