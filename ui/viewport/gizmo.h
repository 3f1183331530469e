#pragma once

#include "engine/math/pose.h"
#include "render/draw/view.h"

#include <Eigen/Core>

#include <optional>

namespace dollytrack::ui {

/// Which handle of the gizmo the mouse has.
enum class GizmoPart { None, MoveX, MoveY, MoveZ, MoveFree, Yaw, Pitch };

struct GizmoView {
    render::View view;                                 // of the viewport's picture
    Eigen::Vector2f origin = Eigen::Vector2f::Zero();  // of the picture in the window, px
    Pose pose;                                         // of the thing that is edited
    bool turns = true;                                 // has a handle for yaw
    bool tilts = true;                                 // and one for pitch
    bool hovered = false;                              // the viewport has the mouse
};

/// What it remembers during a drag.
struct GizmoState {
    GizmoPart dragged = GizmoPart::None;
    Pose begin;
    Eigen::Vector2f pressed_at = Eigen::Vector2f::Zero();  // of the window, px
    bool pressed_with_ctrl = false;  // Ctrl may be up again when the button is
    bool moved = false;              // far enough to be no click
    double grabbed = 0.0;            // m along the axis, or radians around it
    Eigen::Vector3d grabbed_at = Eigen::Vector3d::Zero();
};

struct GizmoActions {
    bool changed = false;
    bool finished = false;
    bool clicked = false;  // it ended without having begun: meant is what lies behind
    bool with_ctrl = false;
    Pose pose;
};

/// Handles over the picture: three arrows and a disc to move, a ring to turn about the vertical and
/// an arc to look up and down. Draws into the current ImGui window.
GizmoActions drawGizmo(const GizmoView& view, GizmoState& state);

/// Whether the mouse is on one of its handles now.
[[nodiscard]] bool isOnGizmo(const GizmoView& view);

/// Where a ray comes nearest to a line: metres along the line's unit direction; nothing when the
/// two are nearly parallel.
[[nodiscard]] std::optional<double> nearestAlong(const render::ViewRay& ray,
                                                 const Eigen::Vector3d& origin,
                                                 const Eigen::Vector3d& axis);

}  // namespace dollytrack::ui
