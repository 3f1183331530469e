#pragma once

#include "engine/math/pose.h"
#include "render/view/view.h"
#include "ui/viewport/pose_change.h"

#include <imgui.h>
#include <Eigen/Core>

#include <optional>

namespace dollytrack::ui {

struct GizmoView {
    render::View view;                                 // the viewport's camera
    Eigen::Vector2f origin = Eigen::Vector2f::Zero();  // top-left of the image in the window, px
    Pose pose;                                         // pose of the edited element
    bool turns = true;                                 // has a yaw handle
    bool tilts = true;                                 // has a pitch handle
    double heading_rad = 0.0;                          // of the element's own x axis
    bool hovered = false;                              // the mouse is over the viewport
};

/// State during a drag.
struct GizmoState {
    GizmoPart dragged = GizmoPart::None;
    Pose begin;
    Pose now;                                              // the pose of the last window frame
    Eigen::Vector2f pressed_at = Eigen::Vector2f::Zero();  // in the window, px
    bool pressed_with_ctrl = false;  // kept because keys may be released before the button
    bool pressed_with_alt = false;
    bool moved = false;    // moved far enough that it is not a click
    double grabbed = 0.0;  // grab position: m along the axis, or rad around it
    Eigen::Vector3d grabbed_at = Eigen::Vector3d::Zero();
};

struct GizmoActions {
    bool changed = false;
    bool finished = false;
    bool clicked = false;  // a press without movement, meant for what lies behind
    bool with_ctrl = false;
    bool with_alt = false;
    PoseChange change;  // since the press
    SnapSteps steps;    // that the change was snapped to
    Pose pose;
};

/// Position of a world point in the window, px; nullopt if it is behind the camera.
[[nodiscard]] std::optional<ImVec2> positionInWindow(const GizmoView& view,
                                                     const Eigen::Vector3d& point);

/// Draws the handles over the image into the current ImGui window and handles the mouse: three
/// arrows and a disc to move, a ring for yaw and an arc for pitch. Ctrl snaps; see snapSteps().
GizmoActions drawGizmo(const GizmoView& view, GizmoState& state);

/// Whether the mouse is on one of the gizmo's handles.
[[nodiscard]] bool isOnGizmo(const GizmoView& view);

/// Intersection of a ray with the plane through the point, perpendicular to the viewing direction.
[[nodiscard]] Eigen::Vector3d onScreenPlane(const render::ViewRay& ray, const GizmoView& view,
                                            const Eigen::Vector3d& point);

/// The intersection of a ray with the plane through a point; nullopt if the ray does not meet it,
/// or meets it at a grazing angle.
[[nodiscard]] std::optional<Eigen::Vector3d> onPlane(const render::ViewRay& ray,
                                                     const Eigen::Vector3d& point,
                                                     const Eigen::Vector3d& normal);

/// Colour of the x, y or z axis (0 to 2), as ImU32.
[[nodiscard]] unsigned axisColor(int axis);

/// The point on a line closest to a ray, as metres from `origin` along the unit direction `axis`;
/// nullopt if the two are nearly parallel.
[[nodiscard]] std::optional<double> nearestAlong(const render::ViewRay& ray,
                                                 const Eigen::Vector3d& origin,
                                                 const Eigen::Vector3d& axis);

}  // namespace dollytrack::ui
