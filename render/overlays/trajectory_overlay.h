#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/trajectory.h"
#include "render/overlays/overlay.h"

namespace dollytrack::render {

/// A trajectory as a line coloured from cool to warm over time, with a small camera frustum and a
/// dot at each key frame (or at even distances if frames have no key frames). Jumps between rooms
/// are not connected.
[[nodiscard]] Overlay trajectoryOverlay(const Trajectory& trajectory, const CameraParams& camera);

/// Colour at a share (0..1) of the trajectory, from cool to warm.
[[nodiscard]] Eigen::Vector4f colorAlong(double share);

/// Adds the edges of a camera frustum, `length_m` deep.
void addFrustum(Overlay& overlay, const Pose& pose, const CameraParams& camera, double length_m,
                const Eigen::Vector4f& rgba, double width_px);

}  // namespace dollytrack::render
