#include "engine/io/pointcloud/cloud_planes.h"

#include "engine/core/random.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dollytrack {
namespace {

constexpr std::size_t kMostPlanes = 24;
constexpr double kLeastArea = 0.3;     // m2
constexpr int kDraws = 300;            // hypotheses per plane
constexpr std::size_t kJudges = 4000;  // points with which a hypothesis is tested
constexpr double kAlike = 0.87;        // cosine of 30 degrees

bool agrees(const CloudPlane& plane, const CloudSamples& samples, std::uint32_t i,
            double tolerance) {
    return std::abs(plane.height(samples.points[i])) < tolerance &&
           plane.normal.dot(samples.normals[i]) > kAlike;
}

std::vector<std::uint32_t> membersOf(const CloudPlane& plane, const CloudSamples& samples,
                                     const std::vector<std::uint32_t>& left, double tolerance) {
    std::vector<std::uint32_t> members;
    for (const std::uint32_t i : left) {
        if (agrees(plane, samples, i, tolerance)) members.push_back(i);
    }
    return members;
}

/// Least-squares fit of the plane to its points.
void refit(const CloudSamples& samples, CloudPlane& plane) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : plane.points) mean += samples.points[i];
    mean /= static_cast<double>(plane.points.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const std::uint32_t i : plane.points) {
        const Eigen::Vector3d d = samples.points[i] - mean;
        spread += d * d.transpose();
    }
    Eigen::Vector3d normal =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    if (normal.dot(plane.normal) < 0.0) normal = -normal;
    plane.normal = normal;
    plane.offset = normal.dot(mean);
}

CloudPlane bestOf(const CloudSamples& samples, const std::vector<std::uint32_t>& left,
                  double tolerance, Random& random) {
    CloudPlane best;
    std::size_t most = 0;
    const std::size_t step = std::max<std::size_t>(1, left.size() / kJudges);
    for (int draw = 0; draw < kDraws; ++draw) {
        const std::uint32_t i = left[random.below(static_cast<std::uint32_t>(left.size()))];
        CloudPlane plane;
        plane.normal = samples.normals[i];
        plane.offset = plane.normal.dot(samples.points[i]);
        std::size_t count = 0;
        for (std::size_t k = 0; k < left.size(); k += step) {
            count += agrees(plane, samples, left[k], tolerance) ? 1U : 0U;
        }
        if (count > most) {
            most = count;
            best = plane;
        }
    }
    return best;
}

}  // namespace

std::vector<CloudPlane> findPlanes(const CloudSamples& samples, double tolerance_m,
                                   const JobContext& job) {
    std::vector<CloudPlane> planes;
    std::vector<std::uint32_t> left(samples.points.size());
    for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
    Random random(1);  // fixed seed, for reproducible planes
    const double face = samples.voxel_m * samples.voxel_m;
    while (planes.size() < kMostPlanes && static_cast<double>(left.size()) * face > kLeastArea &&
           !job.cancelled()) {
        CloudPlane plane = bestOf(samples, left, tolerance_m, random);
        for (int round = 0; round < 3; ++round) {
            plane.points = membersOf(plane, samples, left, tolerance_m);
            if (plane.points.size() < 3) break;
            refit(samples, plane);
        }
        plane.points = membersOf(plane, samples, left, tolerance_m);
        plane.area_m2 = static_cast<double>(plane.points.size()) * face;
        if (plane.area_m2 < kLeastArea) break;
        std::vector<std::uint32_t> rest;
        std::set_difference(left.begin(), left.end(), plane.points.begin(), plane.points.end(),
                            std::back_inserter(rest));
        left = std::move(rest);
        planes.push_back(std::move(plane));
        job.report(static_cast<double>(planes.size()) / kMostPlanes);
    }
    std::stable_sort(planes.begin(), planes.end(), [](const CloudPlane& a, const CloudPlane& b) {
        return a.area_m2 > b.area_m2;
    });
    return planes;
}

}  // namespace dollytrack
