#include "engine/io/pointcloud/cloud_scatter.h"

#include "engine/io/pointcloud/point_grid.h"
#include "engine/jobs/parallel.h"
#include "engine/math/quantile.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack {
namespace {

constexpr std::size_t kJudged = 2000;      // number of points that are measured
constexpr std::size_t kFewNeighbours = 6;  // without the point itself
constexpr double kMostRadius = 0.4;        // m; walls are flat at this scale
constexpr double kSurface = 0.2;           // sigma / radius of a surface; a filled ball has 0.45
constexpr int kRounds = 2;

struct Plane {
    Eigen::Vector3d through = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double sigma = 0.0;
    bool found = false;
};

/// The plane through the points within the radius, weighted by (1 - (d / radius)^2)^2.
Plane planeAt(const PointGrid& grid, const std::vector<Eigen::Vector3d>& points,
              const Eigen::Vector3d& place, double radius) {
    double weight = 0.0;
    std::size_t count = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    grid.forNear(place, radius, [&](std::uint32_t j, double d2) {
        const double share = 1.0 - d2 / (radius * radius);
        const Eigen::Vector3d offset = points[j] - place;
        weight += share * share;
        sum += share * share * offset;
        squares += share * share * offset * offset.transpose();
        ++count;
    });
    Plane plane;
    if (count <= kFewNeighbours || !(weight > 0.0)) return plane;
    const Eigen::Vector3d mean = sum / weight;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / weight -
                                                                mean * mean.transpose());
    plane.through = place + mean;
    plane.normal = solver.eigenvectors().col(0);
    plane.sigma = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
    plane.found = true;
    return plane;
}

std::vector<std::size_t> someOf(std::size_t count) {
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < count; i += count / kJudged + 1) some.push_back(i);
    return some;
}

}  // namespace

double spacingOf(const std::vector<Eigen::Vector3d>& points, double at_least) {
    const std::vector<std::size_t> some = someOf(points.size());
    // On a grid with spacing s the sixth neighbour is at 1.41 s; for random points at 1.38 s.
    constexpr double kSixth = 1.4;
    for (double cell = 2.0 * kSixth * at_least; cell < 100.0; cell *= 2.0) {
        const PointGrid grid(points, cell);
        std::vector<double> sixths(some.size(), std::numeric_limits<double>::infinity());
        parallelFor(some.size(), [&](std::size_t i) {
            std::vector<double> near;
            grid.forNear(points[some[i]], cell,
                         [&](std::uint32_t, double d2) { near.push_back(d2); });
            if (near.size() <= kFewNeighbours) return;
            std::nth_element(near.begin(), near.begin() + kFewNeighbours, near.end());
            sixths[i] = std::sqrt(near[kFewNeighbours]);
        });
        const double sixth = some.empty() ? 0.0 : upperMedian(std::move(sixths));
        if (std::isfinite(sixth)) return sixth / kSixth;
    }
    return at_least;
}

Scatter scatterOf(const std::vector<Eigen::Vector3d>& points, double radius) {
    const std::vector<std::size_t> some = someOf(points.size());
    Scatter scatter;
    scatter.radius_m = radius;
    while (true) {
        const PointGrid grid(points, scatter.radius_m);
        std::vector<double> sigmas(some.size());
        parallelFor(some.size(), [&](std::size_t i) {
            sigmas[i] = planeAt(grid, points, points[some[i]], scatter.radius_m).sigma;
        });
        scatter.sigma_m = some.empty() ? 0.0 : upperMedian(std::move(sigmas));
        if (scatter.sigma_m < kSurface * scatter.radius_m || 2.0 * scatter.radius_m > kMostRadius) {
            return scatter;
        }
        scatter.radius_m *= 2.0;
    }
}

void smoothScatter(std::vector<Eigen::Vector3d>& points, double radius, const JobContext& job) {
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<Eigen::Vector3d> before = points;
        const PointGrid grid(before, radius);
        parallelFor(points.size(), [&](std::size_t i) {
            if (job.cancelled()) return;
            const Plane plane = planeAt(grid, before, before[i], radius);
            if (!plane.found) return;
            points[i] -= plane.normal * plane.normal.dot(points[i] - plane.through);
        });
    }
}

}  // namespace dollytrack
