#pragma once

#include "ui/viewport/gizmo.h"

#include <optional>

namespace dollytrack::editor {

/// The gizmo of the selection across frames: whether it has the mouse, and the pose of a point that
/// is being dragged.
class GizmoSession {
  public:
    [[nodiscard]] bool dragging() const { return state_.dragged != ui::GizmoPart::None; }
    [[nodiscard]] bool turning() const { return state_.dragged == ui::GizmoPart::Yaw; }
    /// Pose of the dragged point; unset if none is dragged.
    [[nodiscard]] const std::optional<Pose>& draggedPose() const { return pose_; }

    /// Whether the gizmo takes the mouse in this frame, before it is drawn: it is being dragged, or
    /// the mouse is over a handle.
    [[nodiscard]] bool takesMouse(ui::GizmoView view) const;
    /// Draws the gizmo of an element that is edited continuously during a drag.
    ui::GizmoActions draw(const ui::GizmoView& view);
    /// Draws the gizmo of a point that is edited when the drag ends; then returns its new pose.
    std::optional<Pose> drawPoint(ui::GizmoView view);
    /// Cancels a drag.
    void drop();

  private:
    ui::GizmoState state_;
    std::optional<Pose> pose_;
};

}  // namespace dollytrack::editor
