#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::cli {

/// The texts of the licence files of a scene, each text once: those beside it and those at the top
/// of its folders of models. Archives are not opened. Licence files are LICENSE, Licence.txt,
/// ATTRIBUTION.md and so on. Warns of files that are left out. Empty if the dataset's own folder
/// contains licence files.
std::string licensesOf(const std::filesystem::path& scene,
                       const std::vector<std::filesystem::path>& model_folders,
                       const std::filesystem::path& dataset);

}  // namespace dollytrack::cli
