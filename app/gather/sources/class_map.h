#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <map>
#include <string>

namespace dollytrack::gather {

/// The name that a class gets in the gathered dataset, by the name that it has in the datasets.
using ClassMap = std::map<std::string, std::string>;

/// Reads a JSON object of names (it begins with `{`), else lines "name,name"; '#' starts a comment.
/// Error: BadInput, a sentence with file and line.
[[nodiscard]] Result<ClassMap> readClassMap(const std::filesystem::path& path);

}  // namespace dollytrack::gather
