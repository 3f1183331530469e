#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/point_cloud.h"

#include <string>
#include <string_view>

namespace dollytrack::io {

/// The points of a text file, one a line: x y z, then red green blue (0 to 255, or 0 to 1), then
/// nx ny nz, in any of these: 3, 6, 7 (an intensity after xyz), 9 or 10 columns. Blanks, tabs,
/// commas or semicolons separate; a first line of names or of a count is skipped, '#' and '//'
/// begin remarks. With names (x, y, z, r, red, nx, ...) the columns may come in any order. Error:
/// BadInput, with the line.
Result<PointCloud> readTextPoints(std::string_view text, const std::string& name);

/// How many words a line of such a file has.
std::size_t countPointNumbers(std::string_view line);

}  // namespace dollytrack::io
