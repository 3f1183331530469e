#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/point_cloud.h"

#include <Eigen/Core>

#include <filesystem>
#include <string_view>
#include <vector>

namespace dollytrack::io {

/// The points of a PLY file (text, or binary of either byte order) with colours (red, green, blue)
/// and normals (nx, ny, nz) where all have them. Errors: BadInput, one sentence with the place.
Result<PointCloud> readPlyCloud(const std::filesystem::path& path);

/// The corners or points of a PLY file, whatever else it holds. Points with a coordinate that is no
/// number are left out. Errors: BadInput, one sentence with the place.
Result<std::vector<Eigen::Vector3d>> readPlyPoints(const std::filesystem::path& path);

/// Whether a PLY file that begins like this holds points and no faces.
bool isPlyOfPoints(std::string_view head);

}  // namespace dollytrack::io
