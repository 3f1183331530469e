#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/files/point_cloud.h"

#include <string_view>

namespace dollytrack {

/// Parses a PCD file (Point Cloud Library, version 0.7: text, binary, compressed). Colours are the
/// fields rgb or rgba, normals normal_x, normal_y and normal_z. An organised cloud (more than one
/// row) is a depth image taken from its VIEWPOINT. Error: BadInput, with the line if there is one.
Result<PointCloud> readPcd(std::string_view bytes, const std::string& name);

}  // namespace dollytrack
