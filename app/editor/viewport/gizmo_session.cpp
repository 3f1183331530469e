#include "app/editor/viewport/gizmo_session.h"

#include <utility>

namespace dollytrack::editor {

bool GizmoSession::takesMouse(ui::GizmoView view) const {
    if (pose_) view.pose = *pose_;
    return dragging() || ui::isOnGizmo(view);
}

void GizmoSession::start(ui::GizmoPart part) {
    drop();
    keys_.part = part;
}

ui::GizmoActions GizmoSession::draw(const ui::GizmoView& view) {
    ui::GizmoView handles = view;
    handles.hovered = view.hovered && !usesKeys();
    ui::GizmoActions actions = ui::drawGizmo(handles, state_);
    if (usesKeys()) actions = ui::followKeys(keys_, view);
    text_ = dragging() ? ui::changeText(part(), {view.heading_rad, keys_.own_axes}, actions.change,
                                        actions.steps)
                       : std::string();
    return actions;
}

std::optional<Pose> GizmoSession::drawPoint(ui::GizmoView view) {
    if (pose_) view.pose = *pose_;
    const ui::GizmoActions actions = draw(view);
    if (actions.changed) pose_ = actions.pose;
    if (!actions.finished) return std::nullopt;
    const std::optional<Pose> moved = std::exchange(pose_, std::nullopt);
    drop();
    return moved;
}

void GizmoSession::drop() {
    state_ = {};
    keys_ = {};
    pose_.reset();
    text_.clear();
}

}  // namespace dollytrack::editor
