#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/files/point_cloud.h"

#include <string>
#include <string_view>

namespace dollytrack {

/// Parses a text file with one point per line: x y z, red green blue (0..1, 0..255 or 0..65535),
/// nx ny nz. The number of columns is 3, 6 or 9, or one more with an intensity after xyz.
/// Separators are blanks, tabs, commas and semicolons; '#' and '//' begin comments. A leading line
/// with the number of points is skipped. With a header line of names (x, y, z, r, red, nx, ...) the
/// columns may be in any order. Error: BadInput, with the line.
Result<PointCloud> readTextPoints(std::string_view text, const std::string& name);

/// Number of words in a line of such a file.
std::size_t countPointNumbers(std::string_view line);

}  // namespace dollytrack
