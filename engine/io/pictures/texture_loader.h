#pragma once

#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack {

struct TextureSet {
    std::vector<Texture> textures;     // one per request; width 0 if not found or not readable
    std::vector<std::string> missing;  // names not found
    std::vector<std::string> broken;   // names found, but not decodable or too large
    int found = 0;
};

/// Lets materials that request the same image file share one texture, because models of a world and
/// parts of a house often use the same ones. Embedded images stay as they are.
void shareTextures(RawScene& scene);

/// Finds and decodes the requested textures in parallel: embedded bytes, otherwise a file in the
/// request's folder (by default that of `scene_path`) or its subfolders, also in another subfolder
/// or in another case than written, otherwise in the same way in `more_folders`. Symbolic links out
/// of the folder are not followed. Images with a side over 1024 px are scaled down by area
/// averaging.
TextureSet loadTextures(const std::filesystem::path& scene_path,
                        const std::vector<TextureRequest>& requests,
                        const std::vector<std::filesystem::path>& more_folders,
                        const JobContext& job);

}  // namespace dollytrack
