#pragma once

#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

struct MappedScene;
class FloorHeights;

/// The lowest level, within 0.2 m, that has at least `least_share` of the fullest level's heights:
/// the median of its heights. There must be at least one height.
[[nodiscard]] double commonLevel(std::vector<double> heights, double least_share);

/// The floor on which one walks, z in the world, m: the level at which a sphere of the camera's
/// radius, `height_m` above the floor, fits in the largest number of map columns. If two storeys
/// are of similar size, it is that of the lower one, because RoomPlan finds doorways on the lowest
/// storey only. Ground under a floor, as in a crawl space, is not counted.
[[nodiscard]] double walkedFloor(const MappedScene& scene, const FloorHeights& floors,
                                 double height_m);

/// The corners of a walk at one height z: from the largest room through the doorways of all rooms,
/// or from one end of the only room to the other. Each is a free position where there is one
/// nearby. Empty without rooms or if cancelled.
[[nodiscard]] std::vector<Eigen::Vector3d> walkedRooms(const MappedScene& scene, double z,
                                                       const JobContext& job);

}  // namespace dollytrack::planning
