#pragma once

#include "render/draw/scene_renderer.h"
#include "render/frames/frame_record.h"
#include "render/gl/context.h"

#include <memory>

namespace dollytrack::render {

/// A scene renderer that owns a windowless context and its render target. Belongs to one thread.
class OffscreenRenderer {
  public:
    /// `context` must be current with its functions loaded, as createHeadlessContext() returns it.
    [[nodiscard]] static Result<OffscreenRenderer> create(std::unique_ptr<gl::Context> context,
                                                          const Scene& scene,
                                                          const LightVolume& light, int width,
                                                          int height);

    /// Draws a view of the size given to create() and reads back its pose, colour, depth and ids.
    /// The caller sets the record's index, time and classes.
    [[nodiscard]] Result<FrameRecord> render(const View& view);

    [[nodiscard]] SceneRenderer& scene() { return *scene_; }
    [[nodiscard]] RenderTarget& target() { return *target_; }

  private:
    OffscreenRenderer() = default;

    // Declared in this order so that OpenGL objects are destroyed before their context.
    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<SceneRenderer> scene_;
    std::unique_ptr<RenderTarget> target_;
};

}  // namespace dollytrack::render
