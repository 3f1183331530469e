#pragma once

#include "engine/core/result.h"
#include "render/gl/handle.h"

#include <Eigen/Core>

#include <array>

namespace dollytrack::render {

/// The surface buffer of RenderTarget with kSamplesPerPixel samples per pixel (multisampling), for
/// antialiased edges. It is needed only while an image is drawn, so one buffer serves all targets
/// of its size.
class MultisampleBuffer {
  public:
    static constexpr int kSamplesPerPixel = 4;  // as in light.frag

    /// Needs 64 bytes of graphics memory per pixel (4 samples). Returns Usage if the driver
    /// supports neither this size nor this many samples.
    [[nodiscard]] static Result<MultisampleBuffer> create(int width, int height);

    /// Sample positions, px from the pixel's centre.
    [[nodiscard]] const std::array<Eigen::Vector2d, kSamplesPerPixel>& offsets() const {
        return offsets_;
    }

  private:
    friend class SurfacePass;
    friend class LightPass;

    gl::Texture color_;
    gl::Texture normal_;
    gl::Texture depth_;
    gl::Framebuffer frame_;
    std::array<Eigen::Vector2d, kSamplesPerPixel> offsets_;
};

}  // namespace dollytrack::render
