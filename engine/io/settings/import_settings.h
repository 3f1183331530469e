#pragma once

#include "engine/core/result.h"
#include "engine/io/settings/import_options.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack {

/// Converts a project's section `import` (`unit_m`, `up_axis`, `labels`, `model_folders`,
/// `annotations`, `regroup` ...) to options of importScene(). Error: BadInput for a wrong type.
Result<ImportOptions> importOptionsFromJson(const nlohmann::json& settings);

/// The inverse conversion. Options that do not describe the scene file (textures, sizes, sandbox,
/// cache) are left out.
nlohmann::json importOptionsToJson(const ImportOptions& options);

}  // namespace dollytrack
