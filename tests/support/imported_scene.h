#pragma once

#include "engine/io/import/scene_import.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::test {

/// The scene of a file; the test fails, and goes on with an empty one, where it cannot be read.
[[nodiscard]] Scene imported(const std::filesystem::path& path, const ImportOptions& options = {});
/// Of a file with this text, alone in a folder of its own.
[[nodiscard]] Scene importedText(const std::string& text, const std::string& name = "room.obj");

/// The first object of this name; null when there is none.
[[nodiscard]] const Object* find(const Scene& scene, const std::string& name);

/// Expects the box around an object's own vertices to have these corners, within 0.1 mm.
void expectBox(const Scene& scene, const std::string& name, const Eigen::Vector3d& low,
               const Eigen::Vector3d& high);

[[nodiscard]] int countTargets(const Scene& scene);

/// Whether one of the lines, of a report say, holds these words.
[[nodiscard]] bool says(const std::vector<std::string>& lines, const std::string& words);

}  // namespace dollytrack::test
