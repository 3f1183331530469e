#pragma once

#include "ui/viewport/gizmo.h"
#include "ui/viewport/pose_change.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace dollytrack::ui {

/// A move or rotation that a key started, as in Blender: it follows the mouse, along the axis or in
/// the plane whose key was pressed, or takes typed numbers.
struct KeyTransform {
    GizmoPart part = GizmoPart::None;  // None: none is in progress
    bool own_axes = false;             // along the element's own axes instead of the world's
    // The numbers typed so far, one for each axis of the move; all empty: it follows the mouse.
    std::array<std::string, 3> typed;
    std::size_t field = 0;                                      // the number that is being typed
    std::optional<Pose> begin;                                  // set in the first window frame
    Pose now;                                                   // the pose of the last window frame
    Eigen::Vector2d cursor_at_begin = Eigen::Vector2d::Zero();  // px of the image

    [[nodiscard]] bool running() const { return part != GizmoPart::None; }
    [[nodiscard]] bool hasNumber() const;  // one was typed
    [[nodiscard]] bool turns() const { return part == GizmoPart::Yaw || part == GizmoPart::Pitch; }
};

/// Handles a typed character. A move: x, y and z choose the axis, or with Shift the plane of the
/// other two; again: the element's own; a third time: free. A rotation: z is the heading, and x the
/// pitch if the element tilts. Digits and the decimal point form the number, - changes its sign,
/// and a tab goes to the next axis' number. Others are ignored.
void typeCharacter(KeyTransform& keys, char character, bool tilts, bool shift = false);
/// Removes the last character of the number.
void eraseCharacter(KeyTransform& keys);

/// The number typed for the move's first, second or third axis, m or degrees; nullopt if none has
/// been typed. "-" alone is 0.
[[nodiscard]] std::optional<double> typedNumber(const KeyTransform& keys, std::size_t field = 0);

/// The change for this position of the mouse in the image, px, or for the typed numbers.
[[nodiscard]] PoseChange changeOf(const KeyTransform& keys, const GizmoView& view,
                                  const Eigen::Vector2d& cursor);

/// Takes mouse and keyboard of this window frame and draws the lines of the axes: Enter or a left
/// click ends the change with `finished`. `view.pose` is the element's current pose.
GizmoActions followKeys(KeyTransform& keys, const GizmoView& view);

}  // namespace dollytrack::ui
