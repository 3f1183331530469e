#pragma once

#include "engine/core/random.h"
#include "planning/visibility/framing.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;

/// Unit directions evenly distributed in the cone of `half_angle` (rad) around `axis`; the axis
/// comes first.
std::vector<Eigen::Vector3d> directionsInCone(const Eigen::Vector3d& axis, double half_angle,
                                              int count);

/// Unit directions all around a target, sorted by angle to `axis`, with elevations from -60 to 85
/// degrees.
std::vector<Eigen::Vector3d> directionsAllAround(const Eigen::Vector3d& axis, int count);

/// Distance from the subject, m, beyond which it fills less than `least_fill` of the image.
double furthestUseful(const ViewEstimator& views, const Subject& subject, double least_fill);

/// Up to `count` random cells where the camera may be and from which the subject fills between
/// `least_fill` and `most_fill` of the image. Fewer if 6 * count draws do not find enough.
std::vector<Eigen::Vector3d> randomPlaces(const FreeSpace& free_space, const SweptSphere& sphere,
                                          const ViewEstimator& views, const Subject& subject,
                                          double least_fill, double most_fill, int count,
                                          Random& random);

}  // namespace dollytrack::planning
