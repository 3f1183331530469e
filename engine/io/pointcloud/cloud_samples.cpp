#include "engine/io/pointcloud/cloud_samples.h"

#include "engine/io/pointcloud/cloud_scatter.h"
#include "engine/io/pointcloud/point_grid.h"
#include "engine/jobs/parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dollytrack {
namespace {

constexpr double kNear = 3.0;                      // neighbourhood for normals, in voxels
constexpr std::size_t kMostNeighboursOfSpeck = 4;  // of dropped samples, including themselves

struct Thinned {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3d> normals;  // sums of the cloud's normals; zero if it has none
};

Thinned thin(const PointCloud& cloud, double voxel) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(cloud.points.size());
    parallelFor(cloud.points.size(), [&](std::size_t i) {
        keys[i] = {PointGrid::keyOf((cloud.points[i] / voxel).array().floor()),
                   static_cast<std::uint32_t>(i)};
    });
    std::sort(keys.begin(), keys.end());
    Thinned result;
    for (std::size_t first = 0; first < keys.size();) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        std::size_t end = first;
        for (; end < keys.size() && keys[end].first == keys[first].first; ++end) {
            sum += cloud.points[keys[end].second];
            if (cloud.normals.empty()) continue;
            const Eigen::Vector3d own = cloud.normals[keys[end].second].cast<double>();
            if (own.allFinite()) normal += own;
        }
        result.points.push_back(sum / static_cast<double>(end - first));
        result.normals.push_back(normal);
        first = end;
    }
    return result;
}

constexpr double kSparse = 1.5;  // in voxels: larger spacings need larger voxels
constexpr double kVoxelsOfScatter = 1.5;
constexpr double kRough = 0.25;  // in configured voxels: less scatter is not smoothed

/// The unit normal of the plane through the neighbours; zero if there are too few.
Eigen::Vector3d normalAt(const PointGrid& grid, const std::vector<Eigen::Vector3d>& points,
                         std::size_t i, double radius) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    std::vector<std::uint32_t> near;
    grid.forNear(points[i], radius, [&](std::uint32_t j, double) {
        near.push_back(j);
        mean += points[j];
    });
    if (near.size() <= kMostNeighboursOfSpeck) return Eigen::Vector3d::Zero();
    mean /= static_cast<double>(near.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const std::uint32_t j : near) {
        spread += (points[j] - mean) * (points[j] - mean).transpose();
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

}  // namespace

CloudSamples sampleCloud(const PointCloud& cloud_m, const CloudParams& params,
                         const JobContext& job) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : cloud_m.points) box.extend(p);
    double voxel = std::max(params.voxel_m, box.sizes().maxCoeff() / 1e6);
    Thinned thinned = thin(cloud_m, voxel);
    const std::size_t most = params.max_points;
    while (thinned.points.size() > most && !job.cancelled()) {
        // Points are on surfaces, so their number is proportional to 1 / voxel^2.
        const double ratio = static_cast<double>(thinned.points.size()) / static_cast<double>(most);
        voxel *= std::max(1.05, std::sqrt(ratio));
        thinned = thin(cloud_m, voxel);
    }
    CloudSamples samples;
    if (const double spacing = spacingOf(thinned.points, voxel); spacing > kSparse * voxel) {
        samples.spacing_m = voxel = spacing;
        thinned = thin(cloud_m, voxel);
    }
    if (const Scatter scatter = scatterOf(thinned.points, kNear * voxel);
        scatter.sigma_m > kRough * params.voxel_m) {
        samples.scatter_m = scatter.sigma_m;
        if (kVoxelsOfScatter * scatter.sigma_m > voxel) {
            voxel = kVoxelsOfScatter * scatter.sigma_m;
            thinned = thin(cloud_m, voxel);
        }
        samples.smoothed_m = std::max(scatter.radius_m, kNear * voxel);
        smoothScatter(thinned.points, samples.smoothed_m, job);
    }
    job.report(0.5);
    const PointGrid grid(thinned.points, kNear * voxel);
    const Eigen::Vector3d middle = box.center();
    std::vector<Eigen::Vector3d> normals(thinned.points.size());
    parallelFor(thinned.points.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        Eigen::Vector3d n = normalAt(grid, thinned.points, i, kNear * voxel);
        const Eigen::Vector3d towards =
            !thinned.normals[i].isZero(1e-9)
                ? thinned.normals[i]
                : Eigen::Vector3d(cloud_m.viewpoint.value_or(middle) - thinned.points[i]);
        if (n.dot(towards) < 0.0) n = -n;
        normals[i] = n;
    });
    samples.voxel_m = voxel;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (normals[i].isZero(0.0)) continue;
        samples.points.push_back(thinned.points[i]);
        samples.normals.push_back(normals[i]);
    }
    job.report(1.0);
    return samples;
}

}  // namespace dollytrack
