#pragma once

#include "ui/viewport/gizmo.h"
#include "ui/viewport/pose_change.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace dollytrack::ui {

/// A move or rotation that a key started, as in Blender: it follows the mouse, along the axis whose
/// key was pressed, or takes a typed number.
struct KeyTransform {
    GizmoPart part = GizmoPart::None;  // None: none is in progress
    bool own_axes = false;             // along the element's own axes instead of the world's
    std::string typed;                 // the number typed so far; empty: follows the mouse
    std::optional<Pose> begin;         // set in the first window frame
    Pose now;                          // the pose of the last window frame
    Eigen::Vector2d cursor_at_begin = Eigen::Vector2d::Zero();  // px of the image

    [[nodiscard]] bool running() const { return part != GizmoPart::None; }
    [[nodiscard]] bool turns() const { return part == GizmoPart::Yaw || part == GizmoPart::Pitch; }
};

/// Handles a typed character. A move: x, y and z choose the axis; again: the element's own axis;
/// a third time: free. A rotation: z is the heading, and x the pitch if the element tilts. Digits
/// and the decimal point form the number, and - changes its sign. Others are ignored.
void typeCharacter(KeyTransform& keys, char character, bool tilts);
/// Removes the last character of the number.
void eraseCharacter(KeyTransform& keys);

/// The typed number, m or degrees; nullopt if none has been typed. "-" alone is 0.
[[nodiscard]] std::optional<double> typedNumber(const KeyTransform& keys);

/// The change for this position of the mouse in the image, px, or for the typed number.
[[nodiscard]] PoseChange changeOf(const KeyTransform& keys, const GizmoView& view,
                                  const Eigen::Vector2d& cursor);

/// Takes mouse and keyboard of this window frame and draws the line of the axis: Enter or a left
/// click ends the change with `finished`. `view.pose` is the element's current pose.
GizmoActions followKeys(KeyTransform& keys, const GizmoView& view);

}  // namespace dollytrack::ui
