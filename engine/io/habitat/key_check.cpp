#include "engine/io/habitat/key_check.h"

#include "engine/core/clean_text.h"
#include "engine/core/field_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace dollytrack::habitat {
namespace {

constexpr std::size_t kMostSlips = 20;
constexpr std::size_t kMostKnown = 10'000;
constexpr std::size_t kLongestKey = 64;

// The keys that Habitat-sim reads, whether they matter here or not.
constexpr auto kDatasetConfigKeys =
    std::to_array<const char*>({"stages", "objects", "articulated_objects", "scene_instances",
                                "light_setups", "semantic_scene_descriptor_instances",
                                "pbr_ibl_configs", "navmesh_instances", "user_defined"});
constexpr auto kSectionKeys =
    std::to_array<const char*>({"paths", "configs", "default_attributes"});
constexpr auto kSceneInstanceKeys = std::to_array<const char*>(
    {"stage_instance", "object_instances", "articulated_object_instances", "translation_origin",
     "default_lighting", "default_pbr_shader_config", "region_pbr_shader_configs",
     "navmesh_instance", "semantic_scene_instance", "user_defined"});
constexpr auto kInstanceKeys = std::to_array<const char*>({"template_name",
                                                           "translation",
                                                           "rotation",
                                                           "translation_origin",
                                                           "motion_type",
                                                           "uniform_scale",
                                                           "non_uniform_scale",
                                                           "mass_scale",
                                                           "apply_scale_to_mass",
                                                           "shader_type",
                                                           "is_instance_visible",
                                                           "semantic_id",
                                                           "semantic_category",
                                                           "fixed_base",
                                                           "auto_clamp_joint_limits",
                                                           "initial_joint_pose",
                                                           "initial_joint_velocities",
                                                           "base_type",
                                                           "inertia_source",
                                                           "link_order",
                                                           "render_mode",
                                                           "user_defined"});
constexpr auto kDescriptionKeys = std::to_array<const char*>({"render_asset",
                                                              "collision_asset",
                                                              "semantic_asset",
                                                              "nav_asset",
                                                              "render_asset_type",
                                                              "collision_asset_type",
                                                              "semantic_asset_type",
                                                              "semantic_descriptor_filename",
                                                              "up",
                                                              "front",
                                                              "semantic_up",
                                                              "semantic_front",
                                                              "origin",
                                                              "scale",
                                                              "gravity",
                                                              "margin",
                                                              "friction_coefficient",
                                                              "rolling_friction_coefficient",
                                                              "spinning_friction_coefficient",
                                                              "restitution_coefficient",
                                                              "linear_damping",
                                                              "angular_damping",
                                                              "units_to_meters",
                                                              "requires_lighting",
                                                              "force_flat_shading",
                                                              "shader_type",
                                                              "has_semantic_textures",
                                                              "is_collidable",
                                                              "is_visible",
                                                              "mass",
                                                              "mass_scale",
                                                              "inertia",
                                                              "COM",
                                                              "compute_COM_from_shape",
                                                              "use_bounding_box_for_collision",
                                                              "use_mesh_for_collision",
                                                              "use_mesh_collision",
                                                              "join_collision_meshes",
                                                              "collision_asset_size",
                                                              "semantic_id",
                                                              "semantic_category",
                                                              "urdf_filepath",
                                                              "uniform_scale",
                                                              "base_type",
                                                              "inertia_source",
                                                              "link_order",
                                                              "render_mode",
                                                              "marker_sets",
                                                              "user_defined"});

template <std::size_t Count>
std::vector<std::string> listFrom(const std::array<const char*, Count>& keys) {
    return {keys.begin(), keys.end()};
}

const std::vector<std::string>& knownKeys(KeyCheck::Place place) {
    static const std::vector<std::string> kDatasetConfig = listFrom(kDatasetConfigKeys);
    static const std::vector<std::string> kSection = listFrom(kSectionKeys);
    static const std::vector<std::string> kSceneInstance = listFrom(kSceneInstanceKeys);
    static const std::vector<std::string> kInstance = listFrom(kInstanceKeys);
    static const std::vector<std::string> kDescription = listFrom(kDescriptionKeys);
    switch (place) {
        case KeyCheck::Place::DatasetConfig:
            return kDatasetConfig;
        case KeyCheck::Place::Section:
            return kSection;
        case KeyCheck::Place::SceneInstance:
            return kSceneInstance;
        case KeyCheck::Place::Instance:
            return kInstance;
        case KeyCheck::Place::Description:
            return kDescription;
    }
    return kDescription;
}

}  // namespace

void KeyCheck::check(const nlohmann::json& object, Place place, const std::string& file) {
    if (!object.is_object()) return;
    const std::vector<std::string>& known = knownKeys(place);
    for (const auto& [key, value] : object.items()) {
        if (key.size() > kLongestKey || fine_.contains({place, key})) continue;
        std::string meant;
        if (std::ranges::find(known, key) == known.end()) meant = closestName(key, known);
        if (meant.empty() && fine_.size() < kMostKnown) fine_.insert({place, key});
        // If the similar key exists as well, this key is not a misspelling of it.
        if (meant.empty() || object.contains(meant)) continue;
        if (seen_.size() >= kMostKnown || !seen_.insert({file, key}).second) continue;
        lines_.push_back(
            fmt::format("{}: the key \"{}\" is unknown and was not read; did you mean "
                        "\"{}\"?",
                        cleanText(file), cleanText(key), meant));
    }
}

std::vector<std::string> KeyCheck::warnings() const {
    std::vector<std::string> lines(
        lines_.begin(),
        lines_.begin() + static_cast<std::ptrdiff_t>(std::min(lines_.size(), kMostSlips)));
    if (lines_.size() > kMostSlips) {
        lines.push_back(
            fmt::format("{} more keys are unknown and were not read", lines_.size() - kMostSlips));
    }
    return lines;
}

}  // namespace dollytrack::habitat
