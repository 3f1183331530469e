#pragma once

#include "engine/io/import/raw_scene.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::io {

/// The "material" list of a 3D-FRONT scene, added to a scene as meshes ask for it.
class Front3dMaterials {
  public:
    /// `folders`: where pictures are looked up as <id>/texture.png. All have to outlive this.
    Front3dMaterials(const nlohmann::json& document,
                     const std::vector<std::filesystem::path>& folders, RawScene& scene);

    /// The scene's material of this uid, grey where there is none; `uvs` are turned as it says.
    std::uint32_t indexOf(const std::string& uid, std::vector<Eigen::Vector3f>& uvs);

  private:
    struct Entry {
        const nlohmann::json* source = nullptr;
        int index = -1;  // into the scene's; -1: not asked for yet
    };
    std::uint32_t add(const nlohmann::json& source);
    int textureOf(const nlohmann::json& source);
    int request(const std::string& name, const std::filesystem::path& folder);

    const std::vector<std::filesystem::path>& folders_;
    RawScene& scene_;
    std::map<std::string, Entry> entries_;
    std::map<std::filesystem::path, int> textures_;
    int plain_ = -1;
};

}  // namespace dollytrack::io
