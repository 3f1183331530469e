#pragma once

#include "engine/core/random.h"
#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/collision/mapped_scene.h"
#include "planning/plan_params.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace dollytrack::planning {

/// Maps the scene. Errors: those of Pipeline::run() that concern the parameters and the map.
Result<MappedScene> mapScene(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                             const PlanParams& params, const JobContext& job);

/// Like mapScene(), but takes existing maps, such as those of a pipeline's last run. They
/// must have been made from this scene, these edits and these parameters. `texture_corners` is left
/// null: only the metrics of a plan read it.
MappedScene mappedSceneOf(std::shared_ptr<const Scene> scene, const PlanEdits& edits,
                          const PlanParams& params, std::shared_ptr<const RayCaster> rays,
                          std::shared_ptr<const FreeSpace> free_space,
                          std::shared_ptr<const AllowedRegion> region);

/// Divides `total` among the rooms in proportion to the volume where the camera fits. Rooms with
/// less than `least` get 0; the largest room gets the remainder. One entry per room.
std::vector<int> shareByRoom(const MappedScene& scene, int total, int least);

/// A random position in a room where the camera fits; after 200 misses the one with the largest
/// clearance.
Eigen::Vector3d randomPlace(const MappedScene& scene, int room, Random& random);

/// Number of frames that a planner may use: that of the clip with duration_s, else `max_frames`,
/// else 300.
int frameBudget(const PlanParams& params);

}  // namespace dollytrack::planning
