#pragma once

#include "ui/viewport/gizmo.h"

#include <Eigen/Geometry>

namespace dollytrack::ui {

/// State of the clipping box's handles between window frames.
struct ClipHandles {
    int dragged = -1;  // face: 2 * axis, plus 1 for the upper one; -1: none
    Eigen::Vector3d centre_at_begin = Eigen::Vector3d::Zero();  // of that face
    double grabbed_m = 0.0;                                     // along the axis from there
};

/// Whether the mouse is on a handle of the box.
[[nodiscard]] bool isOnClipHandle(const GizmoView& view, const Eigen::AlignedBox3d& box);

/// Draws the clipping box with a handle in the middle of each face, which moves the face. Only the
/// view, its origin and `hovered` of `view` are used.
void drawClipHandles(const GizmoView& view, Eigen::AlignedBox3d& box, ClipHandles& state);

}  // namespace dollytrack::ui
