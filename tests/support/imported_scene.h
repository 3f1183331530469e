#pragma once

#include "engine/io/import/scene_import.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::test {

/// Imports a scene; on errors the test fails and continues with an empty scene.
[[nodiscard]] Scene imported(const std::filesystem::path& path, const ImportOptions& options = {});
/// Imports a file with this text, alone in a temporary folder.
[[nodiscard]] Scene importedText(const std::string& text, const std::string& name = "room.obj");

/// The first object with this name; null if there is none.
[[nodiscard]] const Object* find(const Scene& scene, const std::string& name);

/// Expects the box around an object's own vertices to have these corners, within 0.1 mm.
void expectBox(const Scene& scene, const std::string& name, const Eigen::Vector3d& low,
               const Eigen::Vector3d& high);

[[nodiscard]] int countTargets(const Scene& scene);

/// Whether one of the lines contains these words.
[[nodiscard]] bool says(const std::vector<std::string>& lines, const std::string& words);

}  // namespace dollytrack::test
