#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::io {

/// A point cloud as a room: thinned out, levelled, its surface joined, floor, ceiling and walls
/// told from the things that stand in it, its colours as textures. How well the surface lies on the
/// points is said in the notes. Unit and upward axis are those of the options, else judged.
Result<RawScene> readPointCloud(const std::filesystem::path& path, const ImportOptions& options,
                                const JobContext& job);

}  // namespace dollytrack::io
