#include "app/editor/viewport/gizmo_session.h"

#include <utility>

namespace dollytrack::editor {

bool GizmoSession::takesMouse(ui::GizmoView view) const {
    if (pose_) view.pose = *pose_;
    return dragging() || ui::isOnGizmo(view);
}

ui::GizmoActions GizmoSession::draw(const ui::GizmoView& view) {
    return ui::drawGizmo(view, state_);
}

std::optional<Pose> GizmoSession::drawPoint(ui::GizmoView view) {
    if (pose_) view.pose = *pose_;
    const ui::GizmoActions actions = draw(view);
    if (actions.changed) pose_ = actions.pose;
    return actions.finished ? std::exchange(pose_, std::nullopt) : std::nullopt;
}

void GizmoSession::drop() {
    state_ = {};
    pose_.reset();
}

}  // namespace dollytrack::editor
