#pragma once

#include "engine/io/pointcloud/cloud_samples.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::io {

/// A flat surface in a cloud.
struct CloudPlane {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, as the points' own
    double offset = 0.0;                                // normal . p of its points, m
    double area_m2 = 0.0;                               // about: its points times a cube's face
    std::vector<std::uint32_t> points;

    [[nodiscard]] double height(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

/// The largest planes, at most 24, each of at least 0.3 m2, the largest first; a point belongs to
/// one at most. Method: RANSAC (Fischler and Bolles 1981) with points and their normals as
/// samples, drawn with a fixed seed, and least squares over what agrees.
std::vector<CloudPlane> findPlanes(const CloudSamples& samples, double tolerance_m,
                                   const JobContext& job);

}  // namespace dollytrack::io
