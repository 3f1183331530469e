#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/scene/label_table.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <vector>

namespace dollytrack::io {

/// Adds the "mesh" list of a 3D-FRONT scene: walls, floors and what is built in, already in the
/// house's place. Meshes of one kind and one owner (the front part of their uid) become one object;
/// so do built-in cabinets that touch. Materials are those of "material"; their pictures are looked
/// up in the folders.
void addFront3dArchitecture(const nlohmann::json& document, const LabelTable& labels,
                            const std::vector<std::filesystem::path>& texture_folders,
                            RawScene& scene);

}  // namespace dollytrack::io
