#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string_view>

namespace dollytrack::verify {

/// A file of a dataset that may be damaged. Error: BadInput, also when it nests deeper than any of
/// ours, without its place.
Result<nlohmann::json> readJson(const std::filesystem::path& path);

/// The same of a text.
Result<nlohmann::json> parseJson(std::string_view text);

}  // namespace dollytrack::verify
