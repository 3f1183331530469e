#include "ui/overlays/edge_shape.h"

namespace dollytrack::ui {

void addEdge(render::Overlay& overlay, const Plan& plan, const RoadmapEdge& edge,
             const Eigen::Vector4f& rgba, double width_px, double dash_px, std::int32_t tag) {
    const auto& points = plan.position_points;
    Eigen::Vector3d last = points[edge.a].pose.position;
    for (const Eigen::Vector3d& corner : edge.via) {
        overlay.lines.push_back({last, corner, rgba, width_px, dash_px, tag});
        last = corner;
    }
    overlay.lines.push_back({last, points[edge.b].pose.position, rgba, width_px, dash_px, tag});
}

}  // namespace dollytrack::ui
