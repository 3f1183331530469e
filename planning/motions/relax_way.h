#pragma once

#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

struct MappedScene;

/// Moves the points of a collision-free polyline towards their targets, one for each point, like an
/// elastic band that obstacles hold back. It minimises the squared shifts from the targets plus the
/// squared changes of shift, weighted so that a shift fades over about 15 cm. A point moves only
/// where it and the moves to both neighbours are proven free. The ends stay where they are unless
/// they are free.
void relaxWay(const MappedScene& scene, const std::vector<Eigen::Vector3d>& targets,
              bool free_start, bool free_end, const JobContext& job,
              std::vector<Eigen::Vector3d>& way);

}  // namespace dollytrack::planning
