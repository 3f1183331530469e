#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/cloud_params.h"
#include "engine/io/pointcloud/point_cloud.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::io {

/// A cloud thinned out to one point a cube: metres, relative to `origin`, the file's axes.
struct CloudSamples {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3d> normals;  // unit, towards where it was seen from
    double voxel_m = 0.0;                  // as it was in the end
    double spacing_m = 0.0;                // of the points, where they lie further apart than asked
    double scatter_m = 0.0;                // about their surfaces, where that was smoothed
    double smoothed_m = 0.0;               // within this radius; 0: they are as they were scanned
};

/// Means of the points in cubes of `voxel_m`, which grow until no more than `max_points` are left,
/// and are no smaller than the points lie apart or scatter about their surfaces, onto which they
/// are moved then (see cloud_scatter.h); specks with fewer than 4 neighbours are dropped. Normals
/// are of the plane through what is near (within 3 cubes), and point to where the cloud's own
/// normals do, else to the viewpoint, else to the middle of the cloud.
CloudSamples sampleCloud(const PointCloud& cloud_m, const CloudParams& params,
                         const JobContext& job);

}  // namespace dollytrack::io
