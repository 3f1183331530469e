#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack {

struct TextureSet {
    std::vector<Texture> textures;     // one per request; width 0 when not found or not readable
    std::vector<std::string> missing;  // names not found
    std::vector<std::string> broken;   // found, but no picture or too large
    int found = 0;
};

/// Finds and decodes what the materials ask for, in parallel: bytes inside the file, else a file
/// in the request's folder (beside `scene_path` where it has none), in its subfolders, or with
/// another case or folder but the same name. Links out of that folder are not followed. Sides over
/// 1024 px are made smaller by area averaging.
TextureSet loadTextures(const std::filesystem::path& scene_path,
                        const std::vector<TextureRequest>& requests, const JobContext& job);

}  // namespace dollytrack
