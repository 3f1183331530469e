#pragma once

#include "ui/viewport/gizmo.h"
#include "ui/viewport/key_transform.h"

#include <optional>
#include <string>

namespace dollytrack::editor {

/// The gizmo of the selection across frames: whether it has the mouse, and the pose of a point that
/// is being dragged. Moves and rotations that a key started count as drags.
class GizmoSession {
  public:
    [[nodiscard]] bool dragging() const { return part() != ui::GizmoPart::None; }
    [[nodiscard]] bool turning() const { return part() == ui::GizmoPart::Yaw; }
    /// Whether a move or rotation that a key started has the keyboard.
    [[nodiscard]] bool usesKeys() const { return keys_.running(); }
    /// Starts a move (MoveFree) or a rotation (Yaw) that follows mouse and keyboard.
    void start(ui::GizmoPart part);
    /// What the drag does, for the status line: "Move along x: 0.5 m"; empty without a drag.
    [[nodiscard]] const std::string& text() const { return text_; }
    /// Pose of the dragged point; unset if none is dragged.
    [[nodiscard]] const std::optional<Pose>& draggedPose() const { return pose_; }

    /// Whether the gizmo takes the mouse in this frame, before it is drawn: it is being dragged, or
    /// the mouse is over a handle.
    [[nodiscard]] bool takesMouse(ui::GizmoView view) const;
    /// Draws the gizmo of an element that is edited continuously during a drag.
    ui::GizmoActions draw(const ui::GizmoView& view);
    /// Draws the gizmo of a point that is edited when the drag ends; then returns its new pose.
    std::optional<Pose> drawPoint(ui::GizmoView view);
    /// Ends a drag, or a move or rotation by keys.
    void drop();

  private:
    [[nodiscard]] ui::GizmoPart part() const {
        return keys_.running() ? keys_.part : state_.dragged;
    }

    ui::GizmoState state_;
    ui::KeyTransform keys_;
    std::string text_;
    std::optional<Pose> pose_;
};

}  // namespace dollytrack::editor
