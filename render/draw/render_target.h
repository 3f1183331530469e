#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// The images one view is drawn into. Row 0 is the top of the picture.
class RenderTarget {
  public:
    [[nodiscard]] static Result<RenderTarget> create(int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Waits for the drawing and copies the finished picture, 3 bytes a pixel, sRGB.
    void readRgb(std::vector<std::uint8_t>& rgb) const;
    /// Planar depth in metres, 0 where nothing was hit.
    void readDepth(std::vector<float>& depth) const;
    /// The same as it is drawn: no positive number where a surface is seen so nearly along itself
    /// that drawing cannot tell its depth; a ray can, see findCracks().
    void readDrawnDepth(std::vector<float>& depth) const;
    /// Object ids, 0 where nothing was hit.
    void readIds(std::vector<std::uint16_t>& ids) const;

    /// The mean of SceneRenderer's sum of looks: linear light before the tone curve, 3 values a
    /// pixel; 0 where no look was added.
    void readLight(std::vector<float>& light) const;

    /// The finished picture as an OpenGL texture, to be shown in a window.
    [[nodiscard]] unsigned picture() const { return picture_.get(); }
    /// What readDrawnDepth() gives, as an OpenGL texture of 32-bit floats.
    [[nodiscard]] unsigned depth() const { return depth_.get(); }
    /// The depth buffer behind it: 1 at the near plane, 0 infinitely far or at the view's far end.
    [[nodiscard]] unsigned zBuffer() const { return z_buffer_.get(); }

    /// Depth and object id of one pixel; waits for the drawing. For what lies under the mouse.
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
    gl::Texture color_;    // square root of albedo; metallic or emission
    gl::Texture normal_;   // world; roughness
    gl::Texture surface_;  // planar depth of what is lit
    gl::Texture depth_;    // planar depth of the label
    gl::Texture ids_;
    gl::Texture z_buffer_;
    gl::Texture occlusion_;  // and planar depth; of a quarter of the pixels
    gl::Texture soft_occlusion_;
    gl::Texture lit_;
    gl::Texture sum_;    // of several looks, linear; made when first needed
    gl::Texture marks_;  // as a depth buffer: whose looks are added already
    gl::Texture picture_;
    gl::Framebuffer surfaces_frame_;
    gl::Framebuffer looks_frame_;   // the same without those of labels
    gl::Framebuffer labels_frame_;  // and these alone
    gl::Framebuffer occlusion_frame_;
    gl::Framebuffer soft_frame_;
    gl::Framebuffer lit_frame_;
    gl::Framebuffer sum_frame_;
    gl::Framebuffer picture_frame_;
};

}  // namespace dollytrack::render
