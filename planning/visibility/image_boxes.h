#pragma once

#include "engine/math/pose.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// Rays along each side of an object where many frames are looked at.
constexpr int kGlanceGrid = 7;

/// A cheap look, without rays, at whether an image from there could capture the object: half of
/// its extent lies in the image, and it is not too small.
[[nodiscard]] bool mayCapture(const ViewEstimator& views, const Pose& pose, int object_id);

/// Boxes, px, around what is visible of each target that is half in the image, in sight.
[[nodiscard]] std::vector<Eigen::AlignedBox2d> imageBoxes(const ViewEstimator& views,
                                                          const Pose& pose);

}  // namespace dollytrack::planning
