#pragma once

#include "render/overlays/overlay.h"
#include "render/view/view.h"

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Paints an overlay's lines and marks into a finished image of a view without OpenGL; boxes and
/// triangles are ignored (see overlay_renderer.h). Elements behind the surfaces of `depth_m`
/// (planar, 0: nothing) are faint. `pixel_scale` multiplies widths in px, for supersampled
/// images.
void paintOverlay(const Overlay& overlay, const View& view, const std::vector<float>& depth_m,
                  double pixel_scale, std::vector<std::uint8_t>& rgb);

}  // namespace dollytrack::render
