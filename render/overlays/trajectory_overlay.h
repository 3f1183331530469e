#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/trajectory.h"
#include "render/overlays/overlay.h"

namespace dollytrack::render {

/// A trajectory as a line that goes from cool to warm with time, with a small camera pyramid and a
/// dot at each key frame (or at even distances, where frames know no key frames). Jumps between
/// rooms are left open.
[[nodiscard]] Overlay trajectoryOverlay(const Trajectory& trajectory, const CameraParams& camera);

/// The colour at a share (0..1) of the way: from cool to warm.
[[nodiscard]] Eigen::Vector4f colorAlong(double share);

/// The edges of a camera's pyramid, `length_m` deep.
void addFrustum(Overlay& overlay, const Pose& pose, const CameraParams& camera, double length_m,
                const Eigen::Vector4f& rgba, double width_px);

}  // namespace dollytrack::render
