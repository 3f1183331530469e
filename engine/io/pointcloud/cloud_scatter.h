#pragma once

#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {

/// Median spacing of the points of a cloud, m: the square root of the surface area per point,
/// estimated from the distance of the sixth neighbour, for regular grids as well as random points.
/// Returns `at_least` if the points are too few.
double spacingOf(const std::vector<Eigen::Vector3d>& points, double at_least);

/// Deviation of points from the scanned surface.
struct Scatter {
    double sigma_m = 0.0;   // median standard deviation from planes through the neighbours
    double radius_m = 0.0;  // of the neighbourhoods in which the points form a surface
};

/// Measures the scatter. The neighbourhood's radius starts at `radius` and is doubled, up to 0.4 m,
/// until the points in it form a surface.
Scatter scatterOf(const std::vector<Eigen::Vector3d>& points, double radius);

/// Moves each point twice onto the weighted plane through its neighbours within the radius: moving
/// least squares of order 1 (Alexa et al. 2003).
void smoothScatter(std::vector<Eigen::Vector3d>& points, double radius, const JobContext& job);

}  // namespace dollytrack
