#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/point_cloud.h"

#include <string_view>

namespace dollytrack::io {

/// The points of a PCD file (Point Cloud Library, version 0.7: text, binary, compressed), given as
/// its bytes. Colours are its fields rgb or rgba, normals normal_x, normal_y and normal_z. An
/// organised cloud (more than one row) is one picture of depths, seen from its VIEWPOINT.
/// Errors: BadInput, with the line where there is one.
Result<PointCloud> readPcd(std::string_view bytes, const std::string& name);

}  // namespace dollytrack::io
