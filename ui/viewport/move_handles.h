#pragma once

#include "planning/motions/move_settings.h"
#include "render/view/view.h"
#include "ui/viewport/gizmo.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

/// A camera move as it would be made.
struct MovePreview {
    std::vector<Eigen::Vector3d> path;       // positions of the camera, m, world
    std::optional<Eigen::Vector3d> look_at;  // world, m; nullopt: it looks along its path
    double floor_z = 0.0;                    // heights of settings are above it, m
    bool has_subject = false;                // whether an object is looked at
};

/// A point in the viewport that sets a setting of a camera move, named as in planning::MoveKind.
struct MoveHandle {
    std::string setting;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();  // m, world
};

/// The handles of a move: on its path, and one at the centre if it looks at no object. Empty for a
/// path of fewer than two positions.
[[nodiscard]] std::vector<MoveHandle> moveHandles(const planning::MoveRequest& move,
                                                  const MovePreview& preview);

/// A handle being dragged, with the move, path and mouse ray at the start of the drag.
struct MoveDrag {
    MoveHandle handle;
    planning::MoveRequest move;
    MovePreview preview;
    render::ViewRay ray;  // world
};

/// The move's options after dragging the handle to the mouse ray `ray`. Handles of points and of
/// the radius move horizontally, those of heights vertically. The arc's handle turns about its
/// centre, and the arc becomes longer or shorter at both ends.
[[nodiscard]] planning::MoveOptions draggedOptions(const MoveDrag& drag,
                                                   const render::ViewRay& ray);

/// Whether the mouse is on a handle of the move.
[[nodiscard]] bool isOnMoveHandle(const GizmoView& view, const planning::MoveRequest& move,
                                  const MovePreview& preview);

/// Draws the path with its handles and follows the mouse. Only the view, its origin and `hovered`
/// of `view` are used. Returns whether `move.options` changed.
bool drawMoveHandles(const GizmoView& view, const MovePreview& preview, planning::MoveRequest& move,
                     std::optional<MoveDrag>& drag);

}  // namespace dollytrack::ui
