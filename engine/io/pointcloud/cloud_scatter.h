#pragma once

#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::io {

/// Spacing of the points of a cloud, m: the side of the square of surface that each point has,
/// estimated from its sixth neighbour; the median over the cloud. The estimate holds for regular
/// grids and for random points.
double spacingOf(const std::vector<Eigen::Vector3d>& points, double at_least);

/// How points lie about the surface that they were scanned from.
struct Scatter {
    double sigma_m = 0.0;   // standard deviation from planes through their neighbours, median
    double radius_m = 0.0;  // the neighbours: far enough to see a surface in them, not a cloud
};

/// `radius` is the smallest that may be; it grows to 0.4 m.
Scatter scatterOf(const std::vector<Eigen::Vector3d>& points, double radius);

/// Moves each point onto the plane through its neighbours within the radius, the nearest counting
/// most, twice: moving least squares (Alexa and others 2003) of order 1.
void smoothScatter(std::vector<Eigen::Vector3d>& points, double radius, const JobContext& job);

}  // namespace dollytrack::io
