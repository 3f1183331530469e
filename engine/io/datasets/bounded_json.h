#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dollytrack::io {

/// A JSON file of up to 512 MiB. Counted before it is parsed, so that a small file cannot become a
/// large one in memory: at most 5e7 values, nested at most 64 deep. Errors: BadInput.
Result<nlohmann::json> readBoundedJson(const std::filesystem::path& path);

/// The same for a text; `where` goes into errors.
Result<nlohmann::json> parseBoundedJson(std::string_view text, const std::string& where);

/// A finite number, written as one or as a string ("0.5"); data sets have both.
std::optional<double> numberIn(const nlohmann::json& value);

/// The list under this key; nothing where there is none.
const nlohmann::json::array_t& listIn(const nlohmann::json& object, const char* key);

/// The text under this key, clean; empty where there is none.
std::string textIn(const nlohmann::json& object, const char* key);

}  // namespace dollytrack::io
