#pragma once

#include "engine/camera/rig.h"
#include "engine/core/result.h"

#include <filesystem>
#include <string_view>

namespace dollytrack {

/// Reads a rig file, {"format": "dollytrack-rig", "version": 1, "cameras": [...]}; see
/// assets/schemas/rig.schema.json. Error: BadInput, with file and field ("rig.json:
/// cameras[2].fov_deg"), also for keys that are unknown or do not apply to the lens.
Result<Rig> readRig(const std::filesystem::path& file);

/// Parses a camera such as "left:lens=fisheye,fov_deg=180,right_m=-0.1". Error: Usage.
Result<RigCamera> parseRigCamera(std::string_view text);

}  // namespace dollytrack
