#pragma once

#include "ui/overlays/candidates_overlay.h"
#include "ui/overlays/free_space_overlay.h"
#include "ui/overlays/points_overlay.h"
#include "ui/overlays/quality_overlay.h"
#include "ui/overlays/roadmap_overlay.h"
#include "ui/overlays/slice.h"
#include "ui/overlays/surface_overlay.h"
#include "ui/overlays/trajectory_overlay.h"

namespace dollytrack::ui {

/// All verdicts except OutsideRoom: most candidates lie outside the room, where they would hide it.
constexpr ShownVerdicts allButOutside() {
    ShownVerdicts shown = allVerdicts();
    shown[static_cast<std::size_t>(Verdict::OutsideRoom)] = false;
    return shown;
}

/// Settings of the overlays in the viewport. Plain data, saved with the window layout. The current
/// selection is not part of it: the `selected_...` fields of the options keep their default values.
struct LayerSettings {
    bool free_space = false;
    bool sliced = true;  // free space is drawn only within `slice`
    Slice slice;
    FreeSpaceOverlayOptions cells;  // its `slice` is set from `sliced` and `slice`

    bool points = true;
    PointsOverlayOptions point_options;
    bool roadmap = false;
    RoadmapOverlayOptions roadmap_options;
    bool trajectory = true;
    TrajectoryOverlayOptions trajectory_options;
    bool candidates = true;  // candidates of the selected observation point
    bool cone = true;
    ShownVerdicts candidate_kinds = allButOutside();
    bool surface = true;  // what the frames show of all surface, if the plan aims at it
    SurfaceOverlayOptions surface_options;
    bool quality = false;  // weak frames and unseen surface, measured when first shown
    QualityOverlayOptions quality_options;
    bool kept_plan = true;  // the trajectory of the plan that is kept for comparison
    bool no_go_boxes = true;
    bool ceiling_cut = true;  // cut away ceilings, for views from above
    int storey = 0;           // the storey shown by the cut, 1 the lowest; 0: the topmost
    bool grid = false;

    bool operator==(const LayerSettings&) const = default;
};

}  // namespace dollytrack::ui
