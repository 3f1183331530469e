#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"

#include <vector>

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;
class ViewEstimator;
struct ViewpointParams;

/// What the viewpoint searches look at. References must outlive the call.
struct Surroundings {
    const ViewEstimator& views;
    const FreeSpace& free_space;
    const SweptSphere& sphere;
};

struct Viewpoints {
    std::vector<ObservationPoint> observation_points;  // those given, then members split off
    std::vector<ViewpointSearch> searches;             // one an observation point
    std::vector<PositionPoint> position_points;
};

/// Sets P (paper, eq. 1 and 3.2.1): for each observation point the best legal place in the cone
/// around its direction; where the cone has none that captures well, all around it, then anywhere
/// in free space. Members that their group's view does not capture well get a view of their own.
/// Error: Cancelled.
Result<Viewpoints> searchViewpoints(const Surroundings& around,
                                    std::vector<ObservationPoint> observation_points,
                                    const ViewpointParams& params, int seed, const JobContext& job);

}  // namespace dollytrack::planning
