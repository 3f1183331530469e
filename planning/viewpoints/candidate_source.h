#pragma once

#include "engine/core/random.h"
#include "planning/visibility/framing.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;

/// Unit directions spread evenly over the cap of `half_angle` around `axis`, the axis first.
std::vector<Eigen::Vector3d> directionsInCone(const Eigen::Vector3d& axis, double half_angle,
                                              int count);

/// Unit directions all around a target, nearest to the axis first; not steeper than 85 degrees up
/// and 60 down.
std::vector<Eigen::Vector3d> directionsAllAround(const Eigen::Vector3d& axis, int count);

/// From farther than this the subject fills less than this share of the image, m.
double furthestUseful(const ViewEstimator& views, const Subject& subject, double least_fill);

/// Random places where the camera may be from which the subject fills between the two shares of the
/// image.
std::vector<Eigen::Vector3d> randomPlaces(const FreeSpace& free_space, const SweptSphere& sphere,
                                          const ViewEstimator& views, const Subject& subject,
                                          double least_fill, double most_fill, int count,
                                          Random& random);

}  // namespace dollytrack::planning
