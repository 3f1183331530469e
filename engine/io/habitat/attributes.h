#pragma once

#include "engine/io/habitat/dataset_config.h"
#include "engine/io/sandbox/reachable_files.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace dollytrack::habitat {

/// Three numbers, or `usual` without a value; nothing for a value of another kind.
[[nodiscard]] std::optional<Eigen::Vector3d> vectorIn(const nlohmann::json& object, const char* key,
                                                      const Eigen::Vector3d& usual);

/// A rotation of four numbers, w first. Nothing where the value is no rotation.
[[nodiscard]] std::optional<Eigen::Quaterniond> rotationIn(const nlohmann::json& object,
                                                           const char* key);

[[nodiscard]] std::optional<double> numberAt(const nlohmann::json& object, const char* key);

/// Whether the value is false, and whether it is true.
[[nodiscard]] bool isOff(const nlohmann::json& object, const char* key);
[[nodiscard]] bool isOn(const nlohmann::json& object, const char* key);

/// The names of the attributes that say which way a mesh is stored.
struct AxisKeys {
    const char* up = "up";
    const char* front = "front";
};

/// Semantic meshes may have axes of their own; else they have those of the model.
[[nodiscard]] AxisKeys semanticAxisKeys(const nlohmann::json& attributes);

/// Turns the mesh's upward and forward axes to Habitat's: y up, looking along -z.
[[nodiscard]] Eigen::Matrix3d rotationFromUpAndFront(const nlohmann::json& attributes,
                                                     const AxisKeys& keys);

[[nodiscard]] Eigen::Affine3d scaling(const Eigen::Vector3d& scale);

[[nodiscard]] Eigen::Vector3d scaleOf(const nlohmann::json& attributes);

/// The size and axes that a description gives its model.
[[nodiscard]] Eigen::Affine3d modelFromAsset(const nlohmann::json& attributes,
                                             const AxisKeys& keys = {});

/// The name with the description's own in place of the words that stand for it.
[[nodiscard]] std::string withConfigName(std::string name,
                                         const std::filesystem::path& description);

/// The file that a description names, if it is there.
[[nodiscard]] std::optional<std::filesystem::path> assetOf(const Template& found, const char* key,
                                                           const io::ReachableFiles& files);

/// Whether its attributes turn, move or scale a mesh.
[[nodiscard]] bool changesGeometry(const Template& found);

/// Names without a word: HSSD's models are called by 40 hexadecimal digits.
[[nodiscard]] bool isNumberName(const std::string& name);

/// The name of a template without folders and endings.
[[nodiscard]] std::string shortName(const std::string& template_name);

}  // namespace dollytrack::habitat
