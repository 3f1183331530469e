#pragma once

#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

/// Minimum clearance along a polyline, to 1 cm where it is below 10 m. Ends early when cancelled.
/// Steps are at most as long as the free distance around the camera sphere, so only contacts
/// shorter than half a millimetre can be missed. Deliberately independent of the planner's
/// collision proof: it uses the triangles only.
double smallestClearance(const RayCaster& rays, const std::vector<Eigen::Vector3d>& way,
                         double radius, const JobContext& job);

}  // namespace dollytrack::planning
