#pragma once

#include "engine/core/result.h"
#include "engine/io/import/scene_import.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack::io {

/// The import section of a project (`unit_m`, `up_axis`, `labels`, `model_folders`, `annotations`,
/// `regroup`:
/// what a person said of the scene file) as options of importScene(). Error: BadInput for a wrong
/// type.
Result<ImportOptions> importOptionsFromJson(const nlohmann::json& settings);

/// The other way round. What is no matter of the scene file (textures, sizes, where it is read) is
/// not in it.
nlohmann::json importOptionsToJson(const ImportOptions& options);

}  // namespace dollytrack::io
