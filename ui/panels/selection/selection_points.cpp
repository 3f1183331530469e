#include "engine/plan/object_key.h"
#include "ui/panels/edits/edit_parts.h"
#include "ui/panels/selection/selection_details.h"
#include "ui/theme.h"
#include "ui/widgets/fields/drag_fields.h"
#include "ui/widgets/form.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

using nlohmann::json;

constexpr double kDegrees = 180.0 / std::numbers::pi;

const char* kindText(TargetKind kind) {
    switch (kind) {
        case TargetKind::Single:
            return "one object, seen from its front";
        case TargetKind::Support:
            return "objects on a supporting surface";
        case TargetKind::Suspension:
            return "a hanging object";
        case TargetKind::Shelf:
            return "objects inside another";
    }
    return "";
}

/// A position point with the newest edits, which the plan may lack: otherwise each frame of a drag
/// would restart at the plan's pose.
struct Handle {
    const PinnedPoint* pin = nullptr;  // null: the planner chose the pose
    Pose pose;
    std::vector<int> objects;  // objects of its observation point
    [[nodiscard]] bool placedFromView() const { return pin != nullptr && pin->objects.empty(); }
};

Handle findHandle(const SelectionView& view, const PositionPoint& point) {
    Handle handle;
    handle.pose = point.pose;
    const std::size_t index = point.observation_point;
    if (index < view.plan->observation_points.size()) {
        handle.objects = view.plan->observation_points[index].objects;
    }
    if (view.edits == nullptr) return handle;
    // Points for a region or an anchor never correspond to a pin, whatever they capture.
    if (point.fixed && point.pin < 0) return handle;
    const auto& pinned = view.edits->plan.pinned;
    const bool by_number = point.pin >= 0 && point.pin < static_cast<int>(pinned.size()) &&
                           pinned[point.pin].objects.empty();
    handle.pin = by_number ? &pinned[point.pin] : findPin(*view.edits, *view.scene, handle.objects);
    if (handle.pin != nullptr) handle.pose = handle.pin->pose;
    return handle;
}

/// The operation that changes the point's pose; the caller adds the pose fields.
json placing(const SelectionView& view, const Handle& handle) {
    if (handle.placedFromView()) return {{"op", "move_point"}, {"point", handle.pin->name}};
    return {{"op", "pin"},
            {"objects", objectKeys(*view.scene, handle.objects)},
            {"position", pointJson(handle.pose.position)}};
}

void drawPose(const SelectionView& view, const Handle& handle, EditRequest& edit) {
    Eigen::Vector3d position = handle.pose.position;
    const Eigen::Vector3d forward = handle.pose.forward();
    double yaw = std::atan2(forward.y(), forward.x()) * kDegrees;
    double pitch = std::asin(std::clamp(forward.z(), -1.0, 1.0)) * kDegrees;
    formLabel("Place", "x, y, z in m; moving it pins it");
    const FieldEdit moved =
        dragPoint(position, kPlaceRange, "selection.position", "m; drag, or double-click to type");
    formLabel("Heading", "0\u00b0: along x, 90\u00b0: along y; turning it pins it");
    const FieldEdit turned = dragNumber(yaw, kAngleRange, "selection.yaw");
    formLabel("Pitch", "Above the horizon");
    const FieldEdit tilted =
        dragNumber(pitch, {-89.0, 89.0, 0.5F, "%.1f", "\u00b0"}, "selection.pitch");
    json operation = placing(view, handle);
    if (moved.changed) {
        operation["position"] = pointJson(position);
        operation["quaternion_xyzw"] = turnJson(handle.pose.rotation);
    } else if (turned.changed || tilted.changed) {
        operation["yaw_deg"] = wrapDegrees(yaw);
        operation["pitch_deg"] = pitch;
    }
    if (moved.changed || turned.changed || tilted.changed) {
        edit.merge_key = fmt::format("pose.{}.{}", operation["op"].get<std::string>(),
                                     moved.changed    ? "place"
                                     : turned.changed ? "yaw"
                                                      : "pitch");
        edit.operation = std::move(operation);
    }
    edit.ends_merge = edit.ends_merge || moved.finished || turned.finished || tilted.finished;
}

void drawPinning(const SelectionView& view, const Handle& handle, SelectionActions& actions) {
    const std::string why_not =
        handle.objects.empty() && handle.pin == nullptr ? "It has no objects." : "";
    if (handle.pin == nullptr) {
        if (button("Pin", "selection.pin",
                   {.why_not = why_not, .tip = "Planning keeps this pose from now on"})) {
            json operation = placing(view, handle);
            operation["quaternion_xyzw"] = turnJson(handle.pose.rotation);
            actions.edit.operation = std::move(operation);
        }
    } else if (!handle.placedFromView()) {
        if (button("Unpin", "selection.unpin", {.tip = "The planner chooses the pose again"})) {
            actions.edit.operation = {{"op", "unpin"}, {"point", handle.pin->name}};
        }
    } else {
        button("Pin", "selection.pin", {.why_not = "A point placed from a view is always pinned."});
    }
    flowTo("Delete");
    if (button("Delete", "selection.delete",
               {.why_not = why_not, .tip = "Remove this point from the plan"})) {
        actions.edit.operation = handle.placedFromView()
                                     ? json{{"op", "unpin"}, {"point", handle.pin->name}}
                                     : json{{"op", "remove_point"},
                                            {"objects", objectKeys(*view.scene, handle.objects)}};
    }
}

}  // namespace

int frameOf(const Plan& plan, int position_point) {
    const auto& frames = plan.trajectory.frames;
    const auto at = std::ranges::find(frames, position_point, &TrajectoryFrame::position_point);
    return at == frames.end() ? -1 : static_cast<int>(at - frames.begin());
}

std::string positionPointName(const SelectionView& view, int index) {
    const auto& points = view.plan->position_points;
    if (index < 0 || index >= static_cast<int>(points.size())) return {};
    const int target = points[index].observation_point;
    const auto& targets = view.plan->observation_points;
    if (target < 0 || target >= static_cast<int>(targets.size())) return {};
    const std::vector<int>& objects = targets[target].objects;
    if (objects.empty()) return fmt::format("view {}", index);
    return "view of " + objectNames(*view.scene, objects);
}

void drawObservationPoint(const SelectionView& view, SelectionActions& actions) {
    const int index = view.selection->index;
    const ObservationPoint& point = view.plan->observation_points[index];
    heading("Observation point");
    paragraph(kindText(point.kind), palette().text_dim);
    if (beginForm("point")) {
        formLine("Stands for");
        if (auto clicked = objectLinks(*view.scene, point.objects, "selection.object")) {
            actions.select = clicked;
        }
        if (point.supporter != 0) {
            formLine("Supported by");
            if (link(objectName(*view.scene, point.supporter), "selection.carrier")) {
                actions.select = Selection::ofObject(point.supporter);
            }
        }
        formText("Place", placeText(point.position) + " m");
        endForm();
    }
    const bool removed =
        view.edits != nullptr && isRemoved(*view.edits, *view.scene, point.objects);
    const json keys = objectKeys(*view.scene, point.objects);
    if (button("Go to", "selection.frame")) actions.frame = true;
    if (removed) {
        flowTo("Restore");
        if (button("Restore", "selection.restore", {.tip = "Give it a position point again"})) {
            actions.edit.operation = {{"op", "restore_point"}, {"objects", keys}};
        }
        ImGui::TextColored(palette().warning, "Removed manually: it has no position point.");
    } else {
        flowTo("Remove");
        if (button("Remove", "selection.remove",
                   {.why_not = point.objects.empty() ? "It has no objects." : "",
                    .tip = "Give it no position point"})) {
            actions.edit.operation = {{"op", "remove_point"}, {"objects", keys}};
        }
    }
    heading("Search for a view");
    drawSearch(view, index, actions);
}

void drawPositionPoint(const SelectionView& view, SelectionActions& actions) {
    const int index = view.selection->index;
    const PositionPoint& point = view.plan->position_points[index];
    const Handle handle = findHandle(view, point);
    heading("Position point");
    if (link(positionPointName(view, index), "selection.observation_point",
             "Select its observation point")) {
        actions.select =
            Selection::ofItem(Selection::Kind::ObservationPoint, point.observation_point);
    }
    ImGui::TextColored(handle.pin != nullptr ? palette().accent : palette().text_dim, "%s",
                       handle.pin != nullptr ? "\u25a0 pinned"
                       : point.fixed         ? "fixed by a region or an anchor"
                       : point.room_view     ? "a room view: many objects at once"
                       : point.surface_view  ? "a view that covers surface"
                                             : "found by the search");
    if (beginForm("pose")) {
        drawPose(view, handle, actions.edit);
        formText("Fill", fmt::format("{:.0f} %", 100.0 * point.fill),
                 "Share of the image's width or height, whichever is larger");
        const std::size_t target = point.observation_point;
        if (target < view.plan->observation_points.size()) {
            const Eigen::Vector3d& looked_at = view.plan->observation_points[target].position;
            formText("Distance", fmt::format("{:.2f} m", (handle.pose.position - looked_at).norm()),
                     "To its observation point");
        }
        formLine("Frame");
        const int frame = frameOf(*view.plan, index);
        if (frame < 0) {
            ImGui::TextColored(palette().text_dim, "not visited");
        } else if (link(std::to_string(frame), "selection.go_to_frame", "Go to this frame")) {
            actions.go_to_frame = frame;
        }
        endForm();
    }
    if (button("Look through", "selection.look")) actions.look_through = handle.pose;
    flowTo("Unpin");
    drawPinning(view, handle, actions);
    std::vector<int> small;
    std::ranges::copy_if(point.captured, std::back_inserter(small), [&](int id) {
        return std::ranges::find(point.well_captured, id) == point.well_captured.end();
    });
    if (!point.well_captured.empty()) {
        heading("Captures well");
        if (auto clicked = objectLinks(*view.scene, point.well_captured, "selection.well", 16)) {
            actions.select = clicked;
        }
    }
    if (!small.empty()) {
        heading("Captures, but small");
        if (auto clicked = objectLinks(*view.scene, small, "selection.captured", 16)) {
            actions.select = clicked;
        }
    }
    if (point.captured.empty()) paragraph("It captures nothing.", palette().text_dim);
}

}  // namespace dollytrack::ui
