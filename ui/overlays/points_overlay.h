#pragma once

#include "engine/camera/camera_params.h"
#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

namespace dollytrack::ui {

struct PointsOverlayOptions {
    bool observation_points = true;
    bool position_points = true;
    bool frustums = true;     // of key frames
    double frustum_m = 0.32;  // depth of the drawn pyramids
    int selected_observation_point = -1;
    int selected_position_point = -1;
    bool operator==(const PointsOverlayOptions&) const = default;
};

/// As the paper's Figure 6: what is looked at as dots (large targets big and yellow, small ones
/// small and red), where the camera stands as crosses with an arrow along its direction. Key
/// frames, the position points that are visited, stand out and have their pyramids. A selected
/// point has a ring and its line of sight.
[[nodiscard]] PlanLayer pointsLayer(const Scene& scene, const Plan& plan,
                                    const CameraParams& camera,
                                    const PointsOverlayOptions& options);

}  // namespace dollytrack::ui
