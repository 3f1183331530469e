#include "app/editor/gizmo_session.h"

#include <utility>

namespace dollytrack::editor {

ui::GizmoActions GizmoSession::draw(const ui::GizmoView& view) {
    const ui::GizmoActions actions = ui::drawGizmo(view, state_);
    has_mouse_ = actions.has_mouse;
    return actions;
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
