#include "planning/free_space/free_space.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/selection/selection_details.h"
#include "ui/theme.h"
#include "ui/widgets/form.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

namespace dollytrack::ui {
namespace {

/// Rows of a form for both ends of an edge.
void endRows(const SelectionView& view, int a, int b, SelectionActions& actions) {
    for (const auto& [label, index, name] :
         {std::tuple{"From", a, "selection.from"}, std::tuple{"To", b, "selection.to"}}) {
        formLine(label);
        const std::string text = positionPointName(view, index);
        if (!text.empty() && link(text, name)) {
            actions.select = Selection::ofItem(Selection::Kind::PositionPoint, index);
        }
    }
}

double straightLength(const Plan& plan, int a, int b) {
    const auto count = static_cast<int>(plan.position_points.size());
    if (a < 0 || b < 0 || a >= count || b >= count) return 0.0;
    return (plan.position_points[a].pose.position - plan.position_points[b].pose.position).norm();
}

const char* stateText(planning::CellState state) {
    switch (state) {
        case planning::CellState::Free:
            return "free";
        case planning::CellState::Occupied:
            return "occupied";
        case planning::CellState::Unknown:
            return "unknown: outside, or enclosed inside an object";
    }
    return "";
}

std::string clearanceText(const SelectionView& view, const Eigen::Vector3d& place) {
    if (view.free_space == nullptr) return "not known yet";
    return fmt::format("{:.2f} m or more", view.free_space->clearanceLowerBound(place));
}

}  // namespace

void drawEdge(const SelectionView& view, SelectionActions& actions) {
    const RoadmapEdge& edge = view.plan->roadmap.edges[view.selection->index];
    heading("Roadmap edge");
    paragraph(edge.via.empty() ? "A straight move, proven collision-free for the camera's sphere."
                               : "A detour around obstacles, found by RRT*.",
              palette().text_dim);
    if (!beginForm("edge")) return;
    endRows(view, edge.a, edge.b, actions);
    formText("Length", fmt::format("{:.2f} m", edge.length_m));
    if (!edge.via.empty()) formText("Corners", fmt::format("{}", edge.via.size()));
    formText("Used", edge.in_tree ? "part of the tree" : "dropped: it closes a cycle");
    endForm();
    if (button("Go to", "selection.frame")) actions.frame = true;
}

void drawRefusedEdge(const SelectionView& view, SelectionActions& actions) {
    const RefusedEdge& edge = view.plan->roadmap.refused[view.selection->index];
    heading("Colliding edge");
    if (!beginForm("refused")) return;
    endRows(view, edge.a, edge.b, actions);
    formText("Length", fmt::format("{:.2f} m", straightLength(*view.plan, edge.a, edge.b)));
    formLine("Collides with");
    if (edge.object_id == 0) {
        ImGui::TextWrapped("nothing; it would be %s", verdictText(edge.reason).c_str());
    } else if (link(objectName(*view.scene, edge.object_id), "selection.hit")) {
        actions.select = Selection::ofObject(edge.object_id);
    }
    formText("At", placeText(edge.collision) + " m");
    endForm();
    if (button("Go to", "selection.frame")) actions.frame = true;
}

void drawFrame(const SelectionView& view, SelectionActions& actions) {
    const int index = view.selection->index;
    const TrajectoryFrame& frame = view.plan->trajectory.frames[index];
    const Eigen::Vector3d forward = frame.pose.forward();
    constexpr double kDegrees = 57.29577951308232;
    heading(fmt::format("Frame {}", index).c_str());
    if (!beginForm("frame")) return;
    formText("Time", fmt::format("{:.2f} s", frame.time_s));
    formText("Place", placeText(frame.pose.position) + " m");
    formText("Looks",
             fmt::format("{:.0f}\u00b0, {:.0f}\u00b0 up",
                         std::atan2(forward.y(), forward.x()) * kDegrees,
                         std::asin(std::clamp(forward.z(), -1.0, 1.0)) * kDegrees),
             "Heading (0\u00b0: along x, 90\u00b0: along y) and pitch");
    formText("Room", fmt::format("{}", frame.component + 1));
    const std::vector<double>& clearance_m = view.plan->series.clearance_m;
    const auto at = static_cast<std::size_t>(index);
    formText("Clearance",
             view.measured && at < clearance_m.size() ? fmt::format("{:.2f} m", clearance_m[at])
                                                      : clearanceText(view, frame.pose.position),
             "From the camera's centre to the nearest surface");
    formLine("Key frame");
    if (frame.position_point < 0) {
        ImGui::TextColored(palette().text_dim, "no");
    } else if (link(positionPointName(view, frame.position_point), "selection.position_point")) {
        actions.select = Selection::ofItem(Selection::Kind::PositionPoint, frame.position_point);
    }
    endForm();
    if (button("Go to", "selection.go_to_frame")) actions.go_to_frame = index;
    ImGui::SameLine();
    if (button("Look through", "selection.look")) actions.look_through = frame.pose;
    if (!view.measured) return;
    std::vector<int> best_here;
    for (const ObjectCapture& capture : view.plan->captures) {
        const bool here = (capture.captured && capture.best.frame == index) ||
                          (capture.well_captured && capture.best_well.frame == index);
        if (here) best_here.push_back(capture.object_id);
    }
    if (best_here.empty()) return;
    heading("Best frame of");
    if (auto clicked = objectLinks(*view.scene, best_here, "selection.object", 16)) {
        actions.select = clicked;
    }
}

void drawVoxel(const SelectionView& view) {
    const planning::FreeSpace& space = *view.free_space;
    const Eigen::Vector3d& place = view.selection->place;
    const planning::CellState state = space.stateAt(place);
    const double size = space.cellSizeAt(place);
    heading("Voxel");
    if (!beginForm("voxel")) return;
    formText("Place", placeText(place) + " m");
    formText("State", stateText(state));
    const int level = static_cast<int>(std::lround(std::log2(size / space.resolution_m())));
    formText("Cell", fmt::format("{:.3g} m, level {}", size, level),
             "Level 0 has the smallest cells; each level doubles them");
    if (state == planning::CellState::Free) {
        formText("Clearance", clearanceText(view, place), "To the nearest surface");
        const int room = space.componentAt(place);
        formText("Room", room < 0 ? "none: the camera's sphere does not fit here"
                                  : fmt::format("{} ({:.1f} m\u00b3 for the camera's centre)",
                                                room + 1, space.rooms()[room].volume_m3));
    }
    endForm();
}

}  // namespace dollytrack::ui
