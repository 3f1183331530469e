#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace dollytrack::io {

/// The corners or points of a PLY file (text, or binary of either byte order), whatever else it
/// holds. Points with a coordinate that is no number are left out. Errors: BadInput, one sentence
/// with the place.
Result<std::vector<Eigen::Vector3d>> readPlyPoints(const std::filesystem::path& path);

}  // namespace dollytrack::io
