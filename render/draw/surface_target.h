#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

class RenderTarget;

/// Images of what surfaces are, without light: of the same surfaces as RenderTarget's labels, glass
/// and the holes of textures included. Row 0 is the top of the picture.
class SurfaceTarget {
  public:
    /// Of the size of `labels`, whose images of labels are drawn along; it must stay where it is.
    [[nodiscard]] static Result<SurfaceTarget> create(const RenderTarget& labels);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Waits for the drawing. World, about unit length, on the camera's side; 0 where nothing was
    /// hit.
    void readNormals(std::vector<Eigen::Vector3f>& normals) const;
    /// Base colours, 3 bytes a pixel, sRGB; 0 where nothing was hit.
    void readAlbedo(std::vector<std::uint8_t>& albedo) const;

  private:
    friend class SurfacePass;

    int width_ = 0;
    int height_ = 0;
    gl::Texture color_;   // square root of albedo
    gl::Texture normal_;  // world
    gl::Texture z_buffer_;
    gl::Framebuffer frame_;
};

}  // namespace dollytrack::render
