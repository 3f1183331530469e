#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/render_target.h"
#include "render/gl/handle.h"
#include "render/overlays/overlay_buffers.h"
#include "render/overlays/overlay_canvas.h"
#include "render/view/view.h"

#include <span>

namespace dollytrack::render {

/// An overlay and its opacity, for drawing several together.
struct OverlayLayer {
    const OverlayBuffers* buffers = nullptr;
    float opacity = 1.0F;
    /// Factor on `opacity` where a surface of the scene is in front.
    float hidden_opacity = 0.22F;
};

/// Draws overlays over a finished image: sizes in pixels, antialiased edges, faint where hidden
/// by the scene. The OpenGL context in which it was created must be current for every call.
class OverlayRenderer {
  public:
    [[nodiscard]] static Result<OverlayRenderer> create();

    /// Copies the target's image to the canvas and draws the layers in order: boxes and triangles
    /// of all layers first, then lines and marks. The target must hold SceneRenderer's result for
    /// the same view and have the canvas's size. It is not changed, so new overlays need no drawing
    /// of the scene. `pixel_scale` multiplies all widths and sizes, for high-density screens.
    [[nodiscard]] Status draw(std::span<const OverlayLayer> layers, const View& view,
                              const RenderTarget& target, OverlayCanvas& canvas,
                              double pixel_scale = 1.0);

  private:
    OverlayRenderer() = default;
    void drawSurfaces(const OverlayLayer& layer, const View& view, OverlayCanvas& canvas);
    void drawSigns(const gl::Program& program, const OverlayBuffers::Part& part, int count,
                   const OverlayLayer& layer, const View& view, double pixel_scale);

    gl::Program surfaces_;
    gl::Program blend_;
    gl::Program lines_;
    gl::Program marks_;
    gl::VertexArray no_vertices_;
};

}  // namespace dollytrack::render
