#pragma once

#include "planning/visibility/view_estimator.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

/// What a view should show, as points: the extremes of all objects of an observation point.
struct Subject {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  // looked at, world
    std::vector<Eigen::Vector3d> points;               // world
};

Subject makeSubject(const ViewEstimator& views, const std::vector<int>& objects);

/// Share of the image's length that the subject takes in the tighter direction, when it is looked
/// at from `position`; measured to both sides of the middle, so that 1 touches the image's edge.
/// Infinite when part of it lies behind the near plane.
double fillFrom(const ViewEstimator& views, const Subject& subject,
                const Eigen::Vector3d& position);

/// Distance from the subject's centre along `direction` (unit, towards the camera) at which it
/// fills the wished share: D = h + max(S_w v / (fill width), S_h v / (fill height)), with the
/// half depth h and the sizes S seen from that direction (paper, eq. 1 as corrected), then
/// adjusted for perspective.
double distanceForFill(const ViewEstimator& views, const Subject& subject,
                       const Eigen::Vector3d& direction, double fill);

/// Height over width of the subject on the image, or its inverse; 0..1.
double slenderness(const ViewEstimator& views, const Subject& subject,
                   const Eigen::Vector3d& direction);

}  // namespace dollytrack::planning
