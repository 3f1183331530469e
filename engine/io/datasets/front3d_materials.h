#pragma once

#include "engine/io/raw_scene/raw_scene.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dollytrack {

/// The "material" list of a 3D-FRONT scene. Materials are added to the scene when first used.
class Front3dMaterials {
  public:
    /// `folders` are searched for textures <id>/texture.png. All arguments must outlive this.
    Front3dMaterials(const nlohmann::json& document,
                     const std::vector<std::filesystem::path>& folders, RawScene& scene);

    /// The index of the material with this uid, a grey one if there is none. Applies the material's
    /// texture rotation to `uvs`.
    std::uint32_t indexOf(const std::string& uid, std::vector<Eigen::Vector3f>& uvs);

  private:
    struct Entry {
        const nlohmann::json* source = nullptr;
        int index = -1;  // in the scene's materials; -1: not added yet
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

}  // namespace dollytrack
