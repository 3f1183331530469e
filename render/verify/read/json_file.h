#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string_view>

namespace dollytrack::verify {

/// Reads a JSON file that may be damaged. Returns BadInput, without the file's path, also if it
/// nests deeper than any valid file.
Result<nlohmann::json> readJson(const std::filesystem::path& path);

/// The same for a text.
Result<nlohmann::json> parseJson(std::string_view text);

}  // namespace dollytrack::verify
