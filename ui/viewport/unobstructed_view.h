#pragma once

#include "engine/geometry/ray_caster.h"
#include "ui/viewport/viewer_camera.h"

#include <Eigen/Geometry>

#include <functional>

namespace dollytrack::ui {

/// Whether the surface of an object at a world position (m) is omitted from the image, such as a
/// cut-away ceiling.
using IsCutAway = std::function<bool(int object_id, const Eigen::Vector3d& at)>;

/// The fraction, 0..1, of rays from `eye` to 27 points inside a box that reach the box
/// unobstructed. Surfaces for which `left_away` returns true do not block.
[[nodiscard]] double shareSeen(const RayCaster& rays, const Eigen::Vector3d& eye,
                               const Eigen::AlignedBox3d& box, const IsCutAway& left_away);

/// Rotates a camera about its pivot by the smallest of a set of turns for which `share_seen`
/// returns at least 0.8; if none does, by the turn with the largest value. Elevation is kept within
/// 0.05 .. 1.5 rad.
[[nodiscard]] ViewerCamera unobstructedView(
    const ViewerCamera& framed,
    const std::function<double(const ViewerCamera& camera)>& share_seen);

}  // namespace dollytrack::ui
