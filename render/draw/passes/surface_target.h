#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

class RenderTarget;

/// Images of material properties without light, for the same surfaces as RenderTarget's labels:
/// glass and texture holes count as opaque. Row 0 is the top.
class SurfaceTarget {
  public:
    /// Creates images of the size of `labels`. Label depth and ids are drawn into `labels` at the
    /// same time, so it must not be moved or destroyed before this target.
    [[nodiscard]] static Result<SurfaceTarget> create(const RenderTarget& labels);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Normals in the world frame, about unit length, on the camera's side; 0 where nothing was
    /// hit. Waits for the drawing.
    void readNormals(std::vector<Eigen::Vector3f>& normals) const;
    /// Base colours, sRGB, 3 bytes per pixel; 0 where nothing was hit. Waits for the drawing.
    void readAlbedo(std::vector<std::uint8_t>& albedo) const;

  private:
    friend class SurfacePass;

    int width_ = 0;
    int height_ = 0;
    gl::Texture color_;   // square root of linear albedo
    gl::Texture normal_;  // world frame
    gl::Texture z_buffer_;
    gl::Framebuffer frame_;
};

}  // namespace dollytrack::render
