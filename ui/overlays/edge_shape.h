#pragma once

#include "engine/plan/plan.h"
#include "render/overlays/overlay.h"

namespace dollytrack::ui {

/// Adds a roadmap edge as line segments through its intermediate points.
void addEdge(render::Overlay& overlay, const Plan& plan, const RoadmapEdge& edge,
             const Eigen::Vector4f& rgba, double width_px, double dash_px, std::int32_t tag);

}  // namespace dollytrack::ui
