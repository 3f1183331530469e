#pragma once

#include "engine/camera/camera_params.h"
#include "engine/plan/plan.h"
#include "render/overlays/overlay.h"

namespace dollytrack::render {

/// A plan as the paper's Figure 6 shows it: observation points as dots (large targets yellow, small
/// ones red), key frames as crosses with their camera pyramids, and the smoothed path through them,
/// from cool to warm with its length.
[[nodiscard]] Overlay planOverlay(const Scene& scene, const Plan& plan, const CameraParams& camera);

}  // namespace dollytrack::render
