#pragma once

#include "ui/layers.h"
#include "ui/overlays/legend.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::ui {

/// What the panel may read this frame.
struct LayersView {
    Eigen::AlignedBox3d room;  // the slice stays within it; empty: no scene
    double cell_m = 0.05;      // edge of the smallest cells
    int levels = 8;            // of the octree, the smallest cells are level 0
    int storeys = 1;           // of the building
    bool has_map = false;      // there is free space to show
    bool has_plan = false;
    bool stepping = false;             // the steps of the algorithm stand in for the roadmap
    std::vector<Legend> legends;       // of the layers that are drawn
    ShownVerdicts candidates_there{};  // among those of what is selected
};

struct LayersActions {
    bool changed = false;
    bool finished = false;  // a drag is over
};

/// Which layers are drawn over the scene, how, and what their colours mean.
LayersActions drawLayersPanel(const LayersView& view, LayerSettings& settings);

}  // namespace dollytrack::ui
