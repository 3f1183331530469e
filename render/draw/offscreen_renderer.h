#pragma once

#include "render/draw/scene_renderer.h"
#include "render/frames/frame_record.h"
#include "render/gl/context.h"

#include <memory>

namespace dollytrack::render {

/// A scene renderer with a windowless context and images of its own. Belongs to one thread.
class OffscreenRenderer {
  public:
    /// `context` is current and loaded, as createHeadlessContext() returns it.
    [[nodiscard]] static Result<OffscreenRenderer> create(std::unique_ptr<gl::Context> context,
                                                          const Scene& scene,
                                                          const LightVolume& light, int width,
                                                          int height);

    /// Draws a view of the size given to create() and reads its images; the record's index, time
    /// and classes are the caller's.
    [[nodiscard]] Result<FrameRecord> render(const View& view);

    [[nodiscard]] SceneRenderer& scene() { return *scene_; }
    [[nodiscard]] RenderTarget& target() { return *target_; }

  private:
    OffscreenRenderer() = default;

    // In this order, so that OpenGL's things go before the context they live in.
    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<SceneRenderer> scene_;
    std::unique_ptr<RenderTarget> target_;
};

}  // namespace dollytrack::render
