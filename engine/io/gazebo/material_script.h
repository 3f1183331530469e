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
#include <tuple>
#include <vector>

namespace dollytrack::gazebo {

/// The colour and texture of a material in an OGRE material script (.material), from the first pass
/// of its first technique.
struct ScriptMaterial {
    /// Diffuse: linear red, green, blue; the opacity, which is 1 without `scene_blend alpha_blend`.
    std::optional<Eigen::Vector4f> color;
    std::string texture;                                      // file name as written; empty: none
    Eigen::Vector2f texture_scale = Eigen::Vector2f::Ones();  // of the picture; 2: twice as large
};

/// The materials of a script by name. A material that inherits from another one of the script has
/// its colour and texture, unless it sets its own. What cannot be read is skipped without an error.
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

    /// A material of a script, and the file of its texture; an empty path if it has none.
    struct Found {
        ScriptMaterial material;
        std::filesystem::path texture;
    };
    std::optional<Found> find(const std::filesystem::path& folder,
                              const std::vector<std::string>& uris, const std::string& name);

    const ModelPath& files_;
    /// What find() returned, by its arguments.
    std::map<std::tuple<std::filesystem::path, std::vector<std::string>, std::string>,
             std::optional<Found>>
        found_;
    std::map<std::filesystem::path, std::map<std::string, ScriptMaterial>> read_;
    std::uint64_t bytes_ = 0;
};

}  // namespace dollytrack::gazebo
