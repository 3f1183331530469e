#pragma once

#include "ui/overlays/candidates_overlay.h"
#include "ui/overlays/free_space_overlay.h"
#include "ui/overlays/points_overlay.h"
#include "ui/overlays/roadmap_overlay.h"
#include "ui/overlays/slice.h"
#include "ui/overlays/trajectory_overlay.h"

namespace dollytrack::ui {

/// Of the candidates most are outside of the room, where they hide it and say little.
constexpr ShownVerdicts allButOutside() {
    ShownVerdicts shown = allVerdicts();
    shown[static_cast<std::size_t>(Verdict::OutsideRoom)] = false;
    return shown;
}

/// What is drawn over the scene. Plain data: kept with the layout of the window. What is selected
/// is not part of it; the options' `selected_...` stay as they are made.
struct LayerSettings {
    bool free_space = false;
    bool sliced = true;  // free space only within `slice`
    Slice slice;
    FreeSpaceOverlayOptions cells;  // its slice is set from the two above

    bool points = true;
    PointsOverlayOptions point_options;
    bool roadmap = false;
    RoadmapOverlayOptions roadmap_options;
    bool trajectory = true;
    TrajectoryOverlayOptions trajectory_options;
    bool candidates = true;  // of what is selected
    bool cone = true;
    ShownVerdicts candidate_kinds = allButOutside();
    bool no_go_boxes = true;
    bool ceiling_cut = true;  // look into rooms from above
    int storey = 0;           // that is looked into, 1 the lowest; 0: the topmost
    bool grid = false;

    bool operator==(const LayerSettings&) const = default;
};

}  // namespace dollytrack::ui
