#pragma once

#include "render/gl/handle.h"

#include <Eigen/Core>

#include <array>

namespace dollytrack::render {

/// What several looks at every pixel see, drawn at once: the surface buffer of RenderTarget with
/// samples of its own for all that is near an edge. It is needed for as long as a picture is drawn:
/// one serves all targets.
class LookImages {
  public:
    static constexpr int kLooks = 4;

    /// Makes them as large as this; px.
    void resize(int width, int height);

    /// Where in a pixel the looks are, px from its middle.
    [[nodiscard]] const std::array<Eigen::Vector2d, kLooks>& offsets() const { return offsets_; }

  private:
    friend class SurfacePass;
    friend class LightPass;

    int width_ = 0;
    int height_ = 0;
    gl::Texture color_;
    gl::Texture normal_;
    gl::Texture depth_;
    gl::Framebuffer frame_;
    std::array<Eigen::Vector2d, kLooks> offsets_;
};

}  // namespace dollytrack::render
