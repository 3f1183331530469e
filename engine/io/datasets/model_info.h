#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dollytrack::io {

/// What model_info.json says of a 3D-FUTURE model; empty where it does not. Texts are clean.
struct ModelInfo {
    std::string category;
    std::string super_category;
    std::string category_id;
};

/// By jid. Reads both forms there are: the data set's list of {model_id, category, super-category},
/// and the tool box's object of {category_id} by jid. Errors: BadInput.
Result<std::map<std::string, ModelInfo>> readModelInfo(const std::filesystem::path& path);

/// Where findModelInfo() looks besides the folders themselves.
std::vector<std::filesystem::path> modelInfoBeside(
    const std::vector<std::filesystem::path>& folders);

/// model_info.json in one of the folders or beside it; empty where there is none.
std::filesystem::path findModelInfo(const std::vector<std::filesystem::path>& folders);

}  // namespace dollytrack::io
