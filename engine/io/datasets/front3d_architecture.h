#pragma once

#include "engine/io/raw_scene/raw_scene.h"
#include "engine/scene/label_table.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <vector>

namespace dollytrack {

/// Adds the "mesh" list of a 3D-FRONT scene: walls, floors and built-in parts, in the house's
/// frame. Meshes with the same type and owner (the first part of their uid) become one object, and
/// so do built-in cabinets that touch. Textures of their materials are searched for in the folders.
void addFront3dArchitecture(const nlohmann::json& document, const LabelTable& labels,
                            const std::vector<std::filesystem::path>& texture_folders,
                            RawScene& scene);

}  // namespace dollytrack
