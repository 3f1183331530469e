#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

namespace dollytrack::ui {

enum class EdgeColor {
    Part,  // connected components before linking
    Room,  // components of free space
};

struct RoadmapOverlayOptions {
    bool accepted = true;
    bool links = true;
    bool samples = true;
    bool refused = true;
    bool dropped = true;
    bool path = true;
    EdgeColor color = EdgeColor::Part;
    int selected_edge = -1;
    int selected_refused = -1;
    bool operator==(const RoadmapOverlayOptions&) const = default;
};

/// The roadmap, as in the paper's Figure 4: accepted moves coloured by connected component, refused
/// moves in red with a cross at the collision, RRT* samples and links, edges dropped to avoid a
/// cycle (dashed), and the path on top.
[[nodiscard]] PlanLayer roadmapLayer(const Plan& plan, const RoadmapOverlayOptions& options);

}  // namespace dollytrack::ui
