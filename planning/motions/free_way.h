#pragma once

#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dollytrack::planning {

struct MappedScene;

/// If `exact`, the path ends at `position`. Otherwise it ends at a reachable free position near it;
/// a longer path must end closer.
struct WayEnd {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    bool exact = true;
};

/// The collision-free polyline from a free position that stays nearest to the points `along`, by A*
/// on a grid around `from`: it minimises the integral of a constant plus the squared distance to
/// those points. All its moves are proven. Empty if none is found, or if cancelled.
std::optional<std::vector<Eigen::Vector3d>> findFreeWay(const MappedScene& scene,
                                                        const Eigen::Vector3d& from,
                                                        const WayEnd& end,
                                                        const std::vector<Eigen::Vector3d>& along,
                                                        const JobContext& job);

}  // namespace dollytrack::planning
