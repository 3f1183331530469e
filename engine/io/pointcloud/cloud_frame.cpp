#include "engine/io/pointcloud/cloud_frame.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

constexpr double kAlong = 0.87;  // cosine of 30 degrees, the largest tilt of a scan

// Score of a camera's axes, more than all other evidence: a wall before the camera looks like a
// floor below it.
constexpr double kCamera = 4.0;

struct UpCandidate {
    Eigen::Vector3d up;
    double score = 0.0;
    double floor = 0.0;  // score of floors and ceilings only
};

struct Spread {
    double low = 0.0;   // 2nd percentile
    double high = 0.0;  // 98th percentile
    double mean = 0.0;
};

/// Heights of the points along a direction.
Spread spreadAlong(const CloudSamples& samples, const Eigen::Vector3d& up) {
    std::vector<double> heights;
    Spread spread;
    for (const Eigen::Vector3d& p : samples.points) {
        heights.push_back(up.dot(p));
        spread.mean += heights.back() / static_cast<double>(samples.points.size());
    }
    const std::size_t cut = heights.size() / 50;
    const auto at = [&](std::size_t i) {
        std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(i),
                         heights.end());
        return heights[i];
    };
    spread.low = at(cut);
    spread.high = at(heights.size() - 1 - cut);
    return spread;
}

/// Score of an up direction, -1..1: area of the planes that face up at the bottom or down at the
/// top, minus that of the planes that face the wrong way, relative to the area of all planes.
double floorEvidence(const CloudSamples& samples, const std::vector<CloudPlane>& planes,
                     const Eigen::Vector3d& up, const Spread& spread) {
    const double size = std::max(spread.high - spread.low, 1e-9);
    double evidence = 0.0;
    double total = 0.0;
    for (const CloudPlane& plane : planes) {
        total += plane.area_m2;
        const double facing = plane.normal.dot(up);
        if (std::abs(facing) < kAlong) continue;
        double height = 0.0;
        for (const std::uint32_t i : plane.points) height += up.dot(samples.points[i]);
        height = (height / static_cast<double>(plane.points.size()) - spread.low) / size;
        const bool floor_like = height < 0.5;  // in the lower half
        evidence += (floor_like == (facing > 0.0) ? 1.0 : -1.0) * plane.area_m2;
    }
    return total > 0.0 ? evidence / total : 0.0;
}

/// Whether level surfaces between floor and ceiling face up (1) or down (-1); closer to 0 if there
/// are few. Scans show the tops of tables, seats and beds but hardly their undersides, so this
/// tells which way up a closed room is.
double topsEvidence(const CloudSamples& samples, const Eigen::Vector3d& up, const Spread& spread) {
    constexpr double kEnds = 0.12;    // of the height: range of floor and ceiling
    constexpr double kEnough = 0.02;  // share of all samples
    const double size = std::max(spread.high - spread.low, 1e-9);
    double upward = 0.0;
    double downward = 0.0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        const double height = (up.dot(samples.points[i]) - spread.low) / size;
        const double facing = up.dot(samples.normals[i]);
        if (height < kEnds || height > 1.0 - kEnds || std::abs(facing) < kAlong) continue;
        ++(facing > 0.0 ? upward : downward);
    }
    const double enough = kEnough * static_cast<double>(samples.points.size());
    return (upward - downward) / std::max({upward + downward, enough, 1.0});
}

/// Whether the axes are those of a camera at the origin that looks along z (forward = 1: y points
/// down, as in OpenCV) or against z (forward = -1: y points up, as in OpenGL): nearly all surfaces
/// face it and lie in front of it. Against z they must also be in a camera's view, because surfaces
/// of a room face up, too.
bool isCameraFrame(const CloudSamples& samples, const Eigen::Vector3d& origin, double forward) {
    constexpr double kWidestView = 2.0;  // tangent of half of it
    constexpr double kNearlyAll = 0.9;
    std::size_t facing = 0;
    std::size_t in_front = 0;
    std::size_t in_view = 0;
    double mean_z = 0.0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
        const double normal = forward * samples.normals[i].z();
        const Eigen::Vector3d from = samples.points[i] - origin;
        const double depth = forward * from.z();
        facing += normal < 0.2 ? 1U : 0U;
        in_front += depth > 0.0 ? 1U : 0U;
        in_view += from.head<2>().cwiseAbs().maxCoeff() < kWidestView * depth ? 1U : 0U;
        mean_z += normal;
    }
    const auto n = static_cast<double>(samples.points.size());
    const std::size_t placed = forward > 0.0 ? in_front : in_view;
    return static_cast<double>(std::min(facing, placed)) > kNearlyAll * n && mean_z < -0.3 * n;
}

/// The vertical direction along the walls: perpendicular to their normals, and nearest to `up`.
Eigen::Vector3d acrossWalls(const std::vector<CloudPlane>& planes, const Eigen::Vector3d& up) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    double total = 0.0;
    for (const CloudPlane& plane : planes) {
        if (std::abs(plane.normal.dot(up)) > 0.5) continue;
        spread += plane.area_m2 * plane.normal * plane.normal.transpose();
        total += plane.area_m2;
    }
    if (total <= 0.0) return up;
    // If there is only one wall, `up` determines the rotation about its normal.
    spread += 1e-3 * total * (Eigen::Matrix3d::Identity() - up * up.transpose());
    Eigen::Vector3d level =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    if (level.dot(up) < 0.0) level = -level;
    return level;
}

/// The largest plane that faces up or down, if there is one.
const CloudPlane* levelPlane(const std::vector<CloudPlane>& planes, const Eigen::Vector3d& up) {
    for (const CloudPlane& plane : planes) {
        if (std::abs(plane.normal.dot(up)) > kAlong) return &plane;
    }
    return nullptr;
}

}  // namespace

CloudUp findUp(const CloudSamples& samples, const std::vector<CloudPlane>& planes,
               const Eigen::Vector3d& file_origin, std::optional<UpAxis> axis) {
    const bool y_down = isCameraFrame(samples, file_origin, 1.0);
    const bool y_up = !y_down && isCameraFrame(samples, file_origin, -1.0);
    double smallest = 1e300;
    for (int i = 0; i < 3; ++i) {
        const Spread spread = spreadAlong(samples, Eigen::Vector3d::Unit(i));
        smallest = std::min(smallest, spread.high - spread.low);
    }
    std::vector<UpCandidate> candidates;
    for (int i = 0; i < 3; ++i) {
        for (const double sign : {1.0, -1.0}) {
            if (axis && *axis != UpAxis("xyz"[i], sign < 0.0)) continue;
            UpCandidate one;
            one.up = sign * Eigen::Vector3d::Unit(i);
            const Spread spread = spreadAlong(samples, one.up);
            const double size = std::max(spread.high - spread.low, 1e-9);
            one.floor = floorEvidence(samples, planes, one.up, spread);
            // Most points are in the lower half, and rooms are lower than long.
            one.score = 2.0 * one.floor + 1.0 - 2.0 * (spread.mean - spread.low) / size;
            one.score += topsEvidence(samples, one.up, spread);
            if (size < 1.001 * smallest) one.score += 0.4;
            // Common conventions: surveys have z up, models y up, cameras y down.
            if (i == 2 && sign > 0.0) one.score += 0.3;
            if (i == 1 && sign > 0.0) one.score += y_up ? kCamera : 0.15;
            if (i == 1 && sign < 0.0) one.score += y_down ? kCamera : 0.1;
            if (i == 0) one.score -= 0.5;
            candidates.push_back(one);
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const UpCandidate& a, const UpCandidate& b) { return a.score > b.score; });
    CloudUp result;
    result.up = candidates[0].up;
    result.source = axis                             ? "given"
                    : y_down && result.up.y() < -0.5 ? "a camera's axes: y points down"
                    : y_up && result.up.y() > 0.5    ? "a camera's axes: y points up"
                    : candidates[0].floor > 0.1      ? "found by floors and ceilings"
                                                     : "default: no floor was found";
    result.doubtful =
        !axis && candidates.size() > 1 && candidates[0].score - candidates[1].score < 0.3;
    if (const CloudPlane* floor = levelPlane(planes, result.up)) {
        result.up =
            floor->normal.dot(result.up) < 0.0 ? Eigen::Vector3d(-floor->normal) : floor->normal;
        result.source += ", levelled by the largest floor or ceiling";
    } else {
        const Eigen::Vector3d level = acrossWalls(planes, result.up);
        if (level.dot(result.up) > kAlong && !level.isApprox(result.up)) {
            result.up = level;
            result.source += ", levelled by the walls";
        }
    }
    return result;
}

}  // namespace dollytrack
