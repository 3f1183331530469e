#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <Eigen/Core>

#include <array>

namespace dollytrack::render {

/// What several looks at every pixel see, drawn at once: the surface buffer of RenderTarget with
/// samples of its own for all that is near an edge. It is needed for as long as a picture is drawn:
/// one serves all targets of its size.
class LookImages {
  public:
    static constexpr int kLooks = 4;  // as in light.frag

    /// 64 bytes a pixel. Usage: too large, or too many looks, for the driver.
    [[nodiscard]] static Result<LookImages> create(int width, int height);

    /// Where in a pixel the looks are, px from its middle.
    [[nodiscard]] const std::array<Eigen::Vector2d, kLooks>& offsets() const { return offsets_; }

  private:
    friend class SurfacePass;
    friend class LightPass;

    gl::Texture color_;
    gl::Texture normal_;
    gl::Texture depth_;
    gl::Framebuffer frame_;
    std::array<Eigen::Vector2d, kLooks> offsets_;
};

}  // namespace dollytrack::render
