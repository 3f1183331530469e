#pragma once

#include "ui/viewport/gizmo.h"

#include <optional>

namespace dollytrack::editor {

/// The handles at what is selected, over several frames: whether they have the mouse, and where a
/// point is while it is dragged, before that is an edit.
class GizmoSession {
  public:
    [[nodiscard]] bool dragging() const { return state_.dragged != ui::GizmoPart::None; }
    [[nodiscard]] bool turning() const { return state_.dragged == ui::GizmoPart::Yaw; }
    /// Where the dragged point is; nothing while none is dragged.
    [[nodiscard]] const std::optional<Pose>& draggedPose() const { return pose_; }

    /// Whether the mouse is the handles' now, before they are drawn: they are dragged, or it has
    /// come to be over one since the last frame.
    [[nodiscard]] bool takesMouse(ui::GizmoView view) const;
    /// Draws the handles of a thing that is edited at each move.
    ui::GizmoActions draw(const ui::GizmoView& view);
    /// Draws the handles of one that is edited when the drag ends; then returns its new pose.
    std::optional<Pose> drawPoint(ui::GizmoView view);
    /// Forgets a drag.
    void drop();

  private:
    ui::GizmoState state_;
    std::optional<Pose> pose_;
};

}  // namespace dollytrack::editor
