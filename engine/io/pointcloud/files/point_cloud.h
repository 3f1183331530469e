#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dollytrack {

/// The content of a point cloud file, in the file's axes and unit.
struct PointCloud {
    std::vector<Eigen::Vector3d> points;              // finite
    std::vector<std::array<std::uint8_t, 3>> colors;  // sRGB; empty, or one per point
    std::vector<Eigen::Vector3f> normals;             // as in the file; empty, or one per point
    std::size_t left_out = 0;                         // points with a non-finite coordinate
    bool splats = false;  // whether the points are centres of Gaussian splats
    /// The scanner's position for a single depth image; nullopt if unknown or for several images.
    std::optional<Eigen::Vector3d> viewpoint;
};

/// Largest number of points of a file.
constexpr std::size_t kMostCloudPoints = 200'000'000;

}  // namespace dollytrack
