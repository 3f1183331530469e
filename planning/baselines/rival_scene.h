#pragma once

#include "engine/core/random.h"
#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/plan_params.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

class AllowedRegion;
class FreeSpace;
class SweptSphere;
class ViewEstimator;

/// What every planner plans with: one scene, one map of its free space, one camera. Const.
struct RivalScene {
    std::shared_ptr<const Scene> scene;
    PlanEdits edits;  // as the scene numbers its objects
    std::shared_ptr<const RayCaster> rays;
    std::shared_ptr<const FreeSpace> free_space;
    std::shared_ptr<const AllowedRegion> region;
    std::shared_ptr<const SweptSphere> sphere;
    std::shared_ptr<const ViewEstimator> views;
};

/// Errors as Pipeline::run() gives them for the map.
Result<RivalScene> mapRivalScene(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                                 const PlanParams& params, const JobContext& job);

/// `total` shared out over the rooms by the volume that the camera has in them; rooms that come out
/// with less than `least` get nothing, and the largest gets what is left over.
std::vector<int> shareByRoom(const RivalScene& scene, int total, int least);

/// A random place of a room where the camera fits; the room's roomiest one when many tries miss.
Eigen::Vector3d randomPlace(const RivalScene& scene, int room, Random& random);

/// Frames that a planner may use: `max_frames`, or 300 without a limit.
int frameBudget(const PlanParams& params);

}  // namespace dollytrack::planning
