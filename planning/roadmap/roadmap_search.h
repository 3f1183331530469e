#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct RoadmapParams;

/// The sizes that Near weighs: box diagonal (m) of what each position point looks at.
std::vector<double> targetSizes(const Scene& scene,
                                const std::vector<ObservationPoint>& observation_points,
                                const std::vector<PositionPoint>& position_points);

/// The priority search (paper, Algorithm 1) over the key frames: sample p_rand, take the vertex
/// of smallest lambda * distance + delta * size + |turn| (Near), join the two when the camera
/// sphere can move straight between them (Edge, CollisionFree). After `refusal_limit` refusals the
/// sample is left. Differs from the print: both ends become vertices, and pairs already joined or
/// refused are skipped. Error: Cancelled.
Result<Roadmap> searchRoadmap(const std::vector<PositionPoint>& position_points,
                              const std::vector<int>& key_frames, const std::vector<double>& sizes,
                              const SweptSphere& sphere, const RoadmapParams& params, int seed,
                              const JobContext& job);

/// Numbers the connected parts of the roadmap: `group` and `group_count`; -1 for position points
/// that are no key frames.
void findGroups(Roadmap& roadmap, std::size_t position_point_count,
                const std::vector<int>& key_frames);

}  // namespace dollytrack::planning
