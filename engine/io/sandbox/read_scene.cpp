#include "engine/io/sandbox/read_scene.h"

#include <utility>

namespace dollytrack {

Result<DecodedScene> readScene(const SceneFormat& format, const std::filesystem::path& path,
                               const ImportOptions& options, const JobContext& job) {
    Result<RawScene> raw = format.read(path, options, job.stage(0.0, 0.7, "reading"));
    if (!raw) return tl::unexpected(raw.error());
    DecodedScene scene{std::move(*raw), {}};
    shareTextures(scene.raw);
    if (options.read_textures) {
        scene.textures = loadTextures(path, scene.raw.textures, options.model_folders, job);
    }
    return scene;
}

}  // namespace dollytrack
