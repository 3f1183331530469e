#pragma once

#include "engine/math/pose.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// Rays per side of an object's extent where many frames are sampled.
constexpr int kSparseGrid = 7;

/// Quick test without rays whether a view could capture the object: at least half of its extent
/// lies in the image, and that part is large enough. Ignores occlusion. Targets only.
[[nodiscard]] bool mayCapture(const ViewEstimator& views, const Pose& pose, int object_id);

/// Boxes, px, around the visible part of each target that passes mayCapture() and is not fully
/// occluded.
[[nodiscard]] std::vector<Eigen::AlignedBox2d> imageBoxes(const ViewEstimator& views,
                                                          const Pose& pose);

}  // namespace dollytrack::planning
