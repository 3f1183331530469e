#pragma once

#include "engine/camera/camera_params.h"
#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

#include <vector>

namespace dollytrack::ui {

struct PointsOverlayOptions {
    bool observation_points = true;
    bool position_points = true;
    bool frustums = true;      // pyramids at key frames
    double frustum_m = 0.32;   // depth of the drawn pyramids
    std::vector<int> objects;  // ids: only their points; empty: all points
    int selected_observation_point = -1;
    int selected_position_point = -1;
    bool operator==(const PointsOverlayOptions&) const = default;
};

/// The points of a plan, as in the paper's Figure 6. Observation points are dots (large targets big
/// and yellow, small ones small and red); position points are crosses with an arrow along the
/// viewing direction. Key frames, the position points on the trajectory, are highlighted and have
/// camera pyramids. A selected point has a ring and its line of sight.
[[nodiscard]] PlanLayer pointsLayer(const Scene& scene, const Plan& plan,
                                    const CameraParams& camera,
                                    const PointsOverlayOptions& options);

}  // namespace dollytrack::ui
