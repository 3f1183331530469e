#pragma once

#include "engine/io/import/scene_import.h"

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

[[nodiscard]] int countTargets(const Scene& scene);

/// Whether one of the lines contains these words.
[[nodiscard]] bool says(const std::vector<std::string>& lines, const std::string& words);

}  // namespace dollytrack::test
