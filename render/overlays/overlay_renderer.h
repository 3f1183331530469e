#pragma once

#include "engine/core/result.h"
#include "render/draw/render_target.h"
#include "render/draw/view.h"
#include "render/gl/handle.h"
#include "render/overlays/overlay_buffers.h"
#include "render/overlays/overlay_canvas.h"

#include <span>

namespace dollytrack::render {

/// One overlay among those drawn together.
struct OverlayLayer {
    const OverlayBuffers* buffers = nullptr;
    float opacity = 1.0F;
    /// What is left of that where a surface of the scene stands in front.
    float hidden_opacity = 0.22F;
};

/// Draws overlays over a finished picture: widths and sizes in pixels, edges antialiased, what is
/// behind the scene's surfaces faint. Needs the OpenGL context current that it was created in.
class OverlayRenderer {
  public:
    [[nodiscard]] static Result<OverlayRenderer> create();

    /// The canvas takes the target's picture, then the layers in their order: boxes and triangles
    /// of all layers first, then lines and marks. The target must hold what SceneRenderer drew of
    /// this very view and have the canvas's size. It stays as it is, so a change of overlays alone
    /// costs no drawing of the scene. `pixel_scale` multiplies all widths and sizes, for screens of
    /// high density.
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
