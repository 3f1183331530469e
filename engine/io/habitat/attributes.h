#pragma once

#include "engine/io/files/reachable_files.h"
#include "engine/io/habitat/dataset_config.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace dollytrack::habitat {

/// A vector: three numbers, or one number for all three. Returns `usual` if the key is missing or
/// null, and nullopt for any other value.
[[nodiscard]] std::optional<Eigen::Vector3d> vectorIn(const nlohmann::json& object, const char* key,
                                                      const Eigen::Vector3d& usual);

/// A rotation from four numbers w, x, y, z, normalized. Returns the identity if the key is missing
/// or is not a list, and nullopt for a list that is not a rotation.
[[nodiscard]] std::optional<Eigen::Quaterniond> rotationIn(const nlohmann::json& object,
                                                           const char* key);

[[nodiscard]] std::optional<double> numberAt(const nlohmann::json& object, const char* key);

/// Whether the value is the boolean false, or true.
[[nodiscard]] bool isOff(const nlohmann::json& object, const char* key);
[[nodiscard]] bool isOn(const nlohmann::json& object, const char* key);

/// The names of the attributes that give the up and front axes of a mesh.
struct AxisKeys {
    const char* up = "up";
    const char* front = "front";
};

/// The keys for a semantic mesh: its own if the attributes contain one of them, otherwise the
/// model's.
[[nodiscard]] AxisKeys semanticAxisKeys(const nlohmann::json& attributes);

/// Rotation from the mesh's up and front axes to Habitat's: y up, front -z. The identity if the two
/// axes are parallel.
[[nodiscard]] Eigen::Matrix3d rotationFromUpAndFront(const nlohmann::json& attributes,
                                                     const AxisKeys& keys);

[[nodiscard]] Eigen::Affine3d scaling(const Eigen::Vector3d& scale);

[[nodiscard]] Eigen::Vector3d scaleOf(const nlohmann::json& attributes);

/// Transform from the model file's axes to metres with y up, by `scale`, `units_to_meters` and the
/// axes.
[[nodiscard]] Eigen::Affine3d modelFromAsset(const nlohmann::json& attributes,
                                             const AxisKeys& keys = {});

/// Replaces %%CONFIG_NAME_AS_ASSET_FILENAME%% in a name with the description's file name, up to its
/// first dot.
[[nodiscard]] std::string withConfigName(std::string name,
                                         const std::filesystem::path& description);

/// The file that a description names under `key`; nullopt if it names none or it does not exist.
[[nodiscard]] std::optional<std::filesystem::path> assetOf(const Template& found, const char* key,
                                                           const ReachableFiles& files);

/// Whether the attributes rotate, move or scale a mesh.
[[nodiscard]] bool changesGeometry(const Template& found);

/// Whether a name is a hash: HSSD's models are named by 40 hexadecimal digits.
[[nodiscard]] bool isNumberName(const std::string& name);

/// The name of a template without folders and file extensions.
[[nodiscard]] std::string shortName(const std::string& template_name);

}  // namespace dollytrack::habitat
