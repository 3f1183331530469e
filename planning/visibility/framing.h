#pragma once

#include "planning/visibility/view_estimator.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

/// The objects of an observation point as extreme points, for framing.
struct Subject {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // point to look at, world, m
    std::vector<Eigen::Vector3d> points;               // extreme points of the objects, world, m
};

Subject makeSubject(const ViewEstimator& views, const std::vector<int>& objects);

/// Share of the image's width or height, whichever is larger, that the subject takes when the
/// camera at `position` looks at its centre. Measured symmetrically about the image centre, so that
/// 1 touches the image's border. Infinite if part of the subject is nearer than the near plane.
double fillFrom(const ViewEstimator& views, const Subject& subject,
                const Eigen::Vector3d& position);

/// Distance from the subject's centre along `direction` (unit, towards the camera) at which it
/// takes the share `fill` of the image: D = h + max(S_w v / (fill width), S_h v / (fill height)),
/// with the half depth h and the sizes S seen from that direction (paper, eq. 1 as corrected), then
/// corrected for perspective. In m.
double distanceForFill(const ViewEstimator& views, const Subject& subject,
                       const Eigen::Vector3d& direction, double fill);

/// Ratio of the shorter to the longer side of the subject in the image, each as a share of the
/// image's side; 0..1.
double slenderness(const ViewEstimator& views, const Subject& subject,
                   const Eigen::Vector3d& direction);

}  // namespace dollytrack::planning
