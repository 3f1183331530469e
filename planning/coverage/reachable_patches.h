#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/coverage/surface_patches.h"

#include <cstddef>
#include <vector>

namespace dollytrack::planning {

class FreeSpace;
class SweptSphere;

/// Positions where the camera fits, evenly spread over the cells of all rooms: at most twice
/// `about`.
std::vector<Eigen::Vector3d> evenPlaces(const FreeSpace& free_space, const SweptSphere& sphere,
                                        std::size_t about);

/// Samples of the surface visible from these positions, by `rays_around` rays in all directions
/// from each: at most one per grid cell of edge `spacing_m` and orientation. Normals face the
/// position that saw the sample. Deterministic. Error: Cancelled.
Result<std::vector<SurfacePatch>> reachablePatches(const Scene& scene, const RayCaster& rays,
                                                   const std::vector<Eigen::Vector3d>& places,
                                                   int rays_around, double spacing_m,
                                                   const JobContext& job);

/// Keeps the first patch per grid cell of edge `spacing_m` and axis direction (one of six) that is
/// nearest to its normal.
std::vector<SurfacePatch> thinnedOut(const std::vector<SurfacePatch>& patches, double spacing_m);

}  // namespace dollytrack::planning
