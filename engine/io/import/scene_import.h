#pragma once

#include "engine/core/result.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"

#include <filesystem>

namespace dollytrack {

/// Reads a scene file of any supported format (format_table/scene_format.h). Estimates objects,
/// classes, boxes, fronts, unit and up axis; Scene::report lists repairs and doubts. All other code
/// must use this function instead of the model readers. Errors: Usage for invalid options,
/// BadInput, Cancelled.
Result<Scene> importScene(const std::filesystem::path& path, const ImportOptions& options = {},
                          const JobContext& job = {});

}  // namespace dollytrack
