#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/cloud_params.h"
#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"

#include <cstddef>
#include <vector>

namespace dollytrack::io {

/// Triangles over samples; they face where the samples' normals point.
struct CloudSurface {
    std::vector<Triangle> triangles;  // indices of samples
    std::size_t holes_filled = 0;
    std::size_t hole_triangles = 0;  // at the end of the list
};

/// Joins samples that lie in one surface, by an advancing front over their Delaunay tetrahedra
/// (Cohen-Steiner and Da 2004): edges where the scan ends stay open, no edge is longer than
/// `gap_m` or five voxels. Holes within a surface up to `hole_m` wide are then filled with the
/// triangles of least area. Error: Cancelled.
Result<CloudSurface> meshCloud(const CloudSamples& samples, const CloudParams& params,
                               const JobContext& job);

}  // namespace dollytrack::io
