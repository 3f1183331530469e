#pragma once

#include "engine/geometry/ray_caster.h"
#include "ui/viewport/viewer_camera.h"

#include <Eigen/Geometry>

#include <functional>

namespace dollytrack::ui {

/// Whether the picture leaves a surface of an object away at a place in the world.
using LeftAway = std::function<bool(int object_id, const Eigen::Vector3d& at)>;

/// The share, 0..1, of straight ways from an eye to points all over a box that reach the box.
[[nodiscard]] double shareSeen(const RayCaster& rays, const Eigen::Vector3d& eye,
                               const Eigen::AlignedBox3d& box, const LeftAway& left_away);

/// Turns and raises a camera that frames something, by as little as makes `share_seen` tell that
/// most of it is seen; where no direction does, to the one with the largest share.
[[nodiscard]] ViewerCamera clearLook(
    const ViewerCamera& framed,
    const std::function<double(const ViewerCamera& camera)>& share_seen);

}  // namespace dollytrack::ui
