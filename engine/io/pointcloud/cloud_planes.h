#pragma once

#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack {

/// A flat surface in a cloud.
struct CloudPlane {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, on the side of the points' normals
    double offset = 0.0;                                // normal . p of its points, m
    double area_m2 = 0.0;                               // estimate: number of points * voxel^2
    std::vector<std::uint32_t> points;

    [[nodiscard]] double height(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

/// The largest planes, at most 24, each of at least 0.3 m2, by decreasing area; each point belongs
/// to at most one. Method: RANSAC (Fischler and Bolles 1981) with a fixed seed, each hypothesis
/// being a point with its normal, and a least-squares fit to the inliers.
std::vector<CloudPlane> findPlanes(const CloudSamples& samples, double tolerance_m,
                                   const JobContext& job);

}  // namespace dollytrack
