#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/files/point_cloud.h"
#include "engine/io/settings/cloud_params.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {

/// A cloud with one point per voxel, in the axes of the given cloud.
struct CloudSamples {
    std::vector<Eigen::Vector3d> points;   // m
    std::vector<Eigen::Vector3d> normals;  // unit, towards the scanner
    double voxel_m = 0.0;                  // final edge length of the voxels
    double spacing_m = 0.0;                // of the points if larger than the voxels; otherwise 0
    double scatter_m = 0.0;                // standard deviation from the surface, if smoothed
    double smoothed_m = 0.0;               // radius of the smoothing; 0: not smoothed
};

/// Samples a cloud: the mean of the points in each voxel of `voxel_m`. The voxels grow until at
/// most `max_points` are left, and are enlarged for sparse points and for points that scatter about
/// their surfaces; scattered points are also moved onto these (cloud_scatter.h). Samples with fewer
/// than 4 neighbours are dropped. Normals are those of the plane through the neighbours within 3
/// voxels; they point to the side of the cloud's normals, otherwise of its viewpoint, otherwise of
/// its centre.
CloudSamples sampleCloud(const PointCloud& cloud_m, const CloudParams& params,
                         const JobContext& job);

}  // namespace dollytrack
