#pragma once

#include "render/draw/view.h"
#include "render/overlays/overlay.h"

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Paints an overlay's lines and marks without OpenGL (its boxes and triangles are left to
/// overlay_renderer.h) into a finished picture of a view. What is behind the surfaces of `depth_m`
/// (planar, 0: nothing there) shows faintly through them. `pixel_scale` multiplies the widths given
/// in px, for pictures that are made smaller afterwards.
void paintOverlay(const Overlay& overlay, const View& view, const std::vector<float>& depth_m,
                  double pixel_scale, std::vector<std::uint8_t>& rgb);

}  // namespace dollytrack::render
