#pragma once

#include "ui/overlays/layers.h"
#include "ui/overlays/legend.h"
#include "ui/viewport/clip_settings.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::ui {

/// Input of the panel for one window frame.
struct LayersView {
    Eigen::AlignedBox3d room;  // bounds of the slice; empty: no scene is open
    double cell_m = 0.05;      // edge of the smallest cells
    int levels = 8;            // octree levels; level 0 is the smallest cells
    int storeys = 1;           // storeys of the building
    bool has_map = false;      // a free-space map exists
    bool has_plan = false;
    bool measured = false;             // the plan has its metrics
    bool has_surface = false;          // the plan tells what its frames show of all surface
    bool has_kept_plan = false;        // a plan is kept for comparison
    bool measuring_quality = false;    // weak frames are being measured
    bool judging_images = false;       // dark and flat images are being searched
    double quality_fraction = 0.0;     // of either
    bool stepping = false;             // the step view replaces the roadmap
    std::vector<Legend> legends;       // legends of the drawn layers
    ShownVerdicts candidates_there{};  // verdicts that occur among the selected point's candidates
};

struct LayersActions {
    bool changed = false;
    bool finished = false;  // a drag has ended
};

/// Draws the switches of all layers with their options, those of the clipping box and the height
/// above which the scene is hidden, and the legends of the colours.
LayersActions drawLayersPanel(const LayersView& view, LayerSettings& settings, ClipSettings& clip);

}  // namespace dollytrack::ui
