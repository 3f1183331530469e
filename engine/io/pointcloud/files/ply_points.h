#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/files/point_cloud.h"

#include <Eigen/Core>

#include <filesystem>
#include <string_view>
#include <vector>

namespace dollytrack {

/// Reads the points of a PLY file (text, or binary of either byte order), with colours (red, green,
/// blue) and normals (nx, ny, nz) if it has them. Gaussian splats are read as their centres,
/// coloured by the constant term of their colour, without those of less than 10 % opacity. Error:
/// BadInput.
Result<PointCloud> readPlyCloud(const std::filesystem::path& path);

/// Reads only the vertex positions of a PLY file, which may also have faces. Positions with a
/// non-finite coordinate are left out. Error: BadInput.
Result<std::vector<Eigen::Vector3d>> readPlyPoints(const std::filesystem::path& path);

/// Whether a PLY file that begins with `head` has points but no faces.
bool isPlyOfPoints(std::string_view head);

}  // namespace dollytrack
