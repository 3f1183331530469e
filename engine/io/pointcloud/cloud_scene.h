#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack {

/// Reads a point cloud as a room: samples and levels it, reconstructs its surface, separates floor,
/// ceiling, walls and objects, and makes textures of its colours. The notes give the distances of
/// the points from the surface. Unit and up axis are those of the options, otherwise estimated.
/// Errors: BadInput, Cancelled.
Result<RawScene> readPointCloud(const std::filesystem::path& path, const ImportOptions& options,
                                const JobContext& job);

}  // namespace dollytrack
