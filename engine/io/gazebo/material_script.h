#pragma once

#include "engine/io/gazebo/visuals.h"

#include <Eigen/Core>
#include <pugixml.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack::gazebo {

/// The colour and texture of a material in an OGRE material script (.material), from the first pass
/// of its first technique.
struct ScriptMaterial {
    std::optional<Eigen::Vector4f> color;  // diffuse: linear red, green, blue; opacity
    std::string texture;                   // file name as written; empty: none
    Eigen::Vector2f texture_scale = Eigen::Vector2f::Ones();  // of the picture; 2: twice as large
};

/// The materials of a script by name. Materials that inherit from others of the script have their
/// colours and textures; all other content is ignored. Never fails: what cannot be read is skipped.
[[nodiscard]] std::map<std::string, ScriptMaterial> parseMaterialScript(std::string_view text);

/// The material scripts that the visuals of a world refer to; each file is read once.
class MaterialScripts {
  public:
    /// `files` must outlive this object.
    explicit MaterialScripts(const ModelPath& files) : files_(files) {}

    /// Gives a visual the texture of the material that its <script> names, and the colour if it has
    /// none. `folder` is that of the world or model. Returns false if the material is not found.
    bool apply(const pugi::xml_node& script, const std::filesystem::path& folder, Visual& visual);

  private:
    const std::map<std::string, ScriptMaterial>& materialsOf(const std::filesystem::path& file);

    const ModelPath& files_;
    std::map<std::pair<std::filesystem::path, std::string>, std::vector<std::filesystem::path>>
        listed_;  // files by folder and address
    std::map<std::filesystem::path, std::map<std::string, ScriptMaterial>> read_;
    std::uint64_t bytes_ = 0;
};

}  // namespace dollytrack::gazebo
