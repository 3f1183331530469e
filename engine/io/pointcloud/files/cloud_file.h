#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/files/point_cloud.h"

#include <filesystem>

namespace dollytrack {

/// Reads a PLY, PCD, XYZ, TXT, ASC, CSV or PTS file, by its extension. Error: BadInput.
Result<PointCloud> readCloudFile(const std::filesystem::path& path);

}  // namespace dollytrack
