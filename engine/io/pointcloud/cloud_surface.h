#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/io/settings/cloud_params.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"

#include <cstddef>
#include <vector>

namespace dollytrack {

/// A triangle mesh over samples; triangles face in the direction of the samples' normals.
struct CloudSurface {
    std::vector<Triangle> triangles;  // indices of samples
    std::size_t holes_filled = 0;
    std::size_t hole_triangles = 0;  // at the end of the list
};

/// Reconstructs the surface by an advancing front over the Delaunay tetrahedra (Cohen-Steiner and
/// Da 2004). The scan's borders stay open; no edge is longer than the larger of `gap_m` and five
/// voxels. Holes of at most `hole_m` are filled with triangles of least area. Error: Cancelled.
Result<CloudSurface> meshCloud(const CloudSamples& samples, const CloudParams& params,
                               const JobContext& job);

}  // namespace dollytrack
