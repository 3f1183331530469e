#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

namespace dollytrack::ui {

enum class EdgeColor {
    Part,  // connected before linking
    Room,  // component of free space
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

/// As the paper's Figure 4: the moves that were accepted by the colour of their connected part,
/// those that were refused in red with a cross where the camera would hit something, RRT*'s
/// samples and links, edges dropped because they close a cycle dashed, and the path on top.
[[nodiscard]] PlanLayer roadmapLayer(const Plan& plan, const RoadmapOverlayOptions& options);

}  // namespace dollytrack::ui
