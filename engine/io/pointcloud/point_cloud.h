#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dollytrack::io {

/// Points as a scanner or another program wrote them, in the file's own axes and unit.
struct PointCloud {
    std::vector<Eigen::Vector3d> points;              // finite
    std::vector<std::array<std::uint8_t, 3>> colors;  // sRGB; empty, or one per point
    std::vector<Eigen::Vector3f> normals;  // as the file has them; empty, or one per point
    std::size_t left_out = 0;              // points with a coordinate that is no number
    bool splats = false;                   // the points are centres of Gaussian splats
    /// Where the scanner stood, for a picture of depths; nothing where the points were put together
    /// from several places.
    std::optional<Eigen::Vector3d> viewpoint;
};

/// No file may ask for more points than this.
constexpr std::size_t kMostCloudPoints = 200'000'000;

}  // namespace dollytrack::io
