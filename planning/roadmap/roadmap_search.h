#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <vector>

namespace dollytrack::planning {

class SweptSphere;
struct RoadmapParams;

/// By position point: diagonal of the box around its objects, m, the size term of Near's cost; 0
/// without objects.
std::vector<double> targetSizes(const Scene& scene,
                                const std::vector<ObservationPoint>& observation_points,
                                const std::vector<PositionPoint>& position_points);

/// Builds the roadmap over the key frames by the priority search (paper, Algorithm 1): samples
/// p_rand, takes the vertex of smallest lambda * distance + delta * size + |turn| (Near), and joins
/// the two if the camera sphere can move straight between them (Edge, CollisionFree). A sample is
/// left after `refusal_limit` refusals or four edges. Only key frames in the same component and
/// room are joined. Differs from the paper: both ends become vertices, and pairs already joined or
/// refused are skipped. Error: Cancelled.
Result<Roadmap> searchRoadmap(const std::vector<PositionPoint>& position_points,
                              const std::vector<int>& key_frames, const std::vector<double>& sizes,
                              const SweptSphere& sphere, const RoadmapParams& params, int seed,
                              const JobContext& job);

/// Labels the connected parts of the roadmap. Sets `group_count`, and `group` of each position
/// point; -1 for those that are not key frames.
void findGroups(Roadmap& roadmap, std::size_t position_point_count,
                const std::vector<int>& key_frames);

}  // namespace dollytrack::planning
