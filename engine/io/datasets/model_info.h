#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dollytrack {

/// The entry of a 3D-FUTURE model in model_info.json; missing values are empty. Texts are clean.
struct ModelInfo {
    std::string category;
    std::string super_category;
    std::string category_id;
};

/// Reads the entries by jid. Supports both variants: the dataset's list of {model_id, category,
/// super-category}, and the toolbox's object of {category_id} by jid. Error: BadInput.
Result<std::map<std::string, ModelInfo>> readModelInfo(const std::filesystem::path& path);

/// The paths that findModelInfo() tries in addition to the folders themselves.
std::vector<std::filesystem::path> modelInfoBeside(
    const std::vector<std::filesystem::path>& folders);

/// Path of model_info.json in one of the folders or beside it; empty if there is none.
std::filesystem::path findModelInfo(const std::vector<std::filesystem::path>& folders);

}  // namespace dollytrack
