#pragma once

#include "engine/math/pose.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// What a gizmo handle or a key changes; MoveFree moves parallel to the screen, MoveXY in the
/// plane of these two axes.
enum class GizmoPart { None, MoveX, MoveY, MoveZ, MoveYZ, MoveXZ, MoveXY, MoveFree, Yaw, Pitch };

/// The axis of MoveX, MoveY and MoveZ: 0 to 2; nullopt for all others.
[[nodiscard]] std::optional<int> moveAxis(GizmoPart part);
/// MoveX, MoveY or MoveZ.
[[nodiscard]] GizmoPart moveAlong(int axis);
/// The axis that MoveYZ, MoveXZ and MoveXY lock: 0 to 2; nullopt for all others.
[[nodiscard]] std::optional<int> lockedAxis(GizmoPart part);
/// MoveYZ, MoveXZ or MoveXY: a move with this axis locked.
[[nodiscard]] GizmoPart moveWithout(int axis);
/// The axes that a move can follow: one, two, or three. Empty for rotations.
[[nodiscard]] std::vector<int> axesOf(GizmoPart part);

/// The directions that moves are constrained to: of the world, or of the element itself, whose x
/// axis has a heading. z points up in both.
struct MoveAxes {
    double heading_rad = 0.0;
    bool own = false;

    [[nodiscard]] Eigen::Vector3d direction(int axis) const;
};

/// A move or rotation relative to the pose at its beginning.
struct PoseChange {
    Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  // world
    double yaw_rad = 0.0;                                // about the vertical, counter-clockwise
    double pitch_rad = 0.0;                              // upwards

    /// The pose after the change. Its view is at most 88 degrees from level.
    [[nodiscard]] Pose of(const Pose& begin) const;
    /// The part of the change that of() applies.
    [[nodiscard]] PoseChange appliedTo(const Pose& begin) const;
};

/// Steps that a change snaps to; 0: it does not snap.
struct SnapSteps {
    double move_m = 0.0;
    double turn_deg = 0.0;
};

/// The steps for the held keys: 0.1 m and 15 degrees with Ctrl, 0.01 m and 1 degree with Shift,
/// too.
[[nodiscard]] SnapSteps snapSteps(bool ctrl, bool shift);

/// The nearest change in whole steps, along each of the move's axes.
[[nodiscard]] PoseChange snapped(GizmoPart part, const MoveAxes& axes, const PoseChange& change,
                                 const SnapSteps& steps);

/// "Move along x: 0.5 m", "Move in its own xy plane: -2, 0.5 m",
/// "Rotate about z: 90° (steps of 15°)".
[[nodiscard]] std::string changeText(GizmoPart part, const MoveAxes& axes, const PoseChange& change,
                                     const SnapSteps& steps = {});

}  // namespace dollytrack::ui
