#pragma once

#include "engine/camera/camera_params.h"
#include "engine/plan/plan.h"
#include "render/overlays/overlay.h"

namespace dollytrack::render {

/// A plan in the style of the paper's Figure 6: observation points as dots (large targets yellow,
/// small ones red), key frames as crosses with camera frusta, and the smoothed path, coloured from
/// cool to warm along its length.
[[nodiscard]] Overlay planOverlay(const Scene& scene, const Plan& plan, const CameraParams& camera);

}  // namespace dollytrack::render
