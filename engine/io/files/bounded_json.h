#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dollytrack {

class GuardedFolder;

/// The deepest nesting that is read. Our own files and those of data sets stay far below it.
/// Copies, writers and visitors of JSON recurse, so deeper files would overflow the stack.
inline constexpr int kDeepestJson = 64;

/// The most fields of an object of nlohmann::ordered_json, which takes quadratic time to parse.
inline constexpr int kMostOrderedFields = 10'000;

/// Decides during parsing which values are kept; see nlohmann::basic_json::parser_callback_t.
template <class Json>
using JsonFilter = typename Json::parser_callback_t;

/// Keeps one field of a file's outermost object.
JsonFilter<nlohmann::json> onlyField(std::string name);

/// Reads a JSON file. All JSON of other origin than this process is read by this function or by
/// parseBoundedJson(). The text is measured before it is parsed: at most 512 MiB, nested at most
/// kDeepestJson deep, and of values that take at most 2 GiB of memory. An object of
/// nlohmann::ordered_json has at most kMostOrderedFields fields. `Json` is nlohmann::json or
/// nlohmann::ordered_json. Error: BadInput, with file, line and column.
template <class Json = nlohmann::json>
Result<Json> readBoundedJson(const std::filesystem::path& path,
                             const JsonFilter<Json>& keep = nullptr);

/// The same, of a file in a guarded folder.
template <class Json = nlohmann::json>
Result<Json> readBoundedJson(const GuardedFolder& folder, const std::string& name,
                             const JsonFilter<Json>& keep = nullptr);

/// Parses a text within the same limits. `where` names the text in errors.
template <class Json = nlohmann::json>
Result<Json> parseBoundedJson(std::string_view text, const std::string& where,
                              const JsonFilter<Json>& keep = nullptr);

/// A JSON object whose field `name`, an object of many fields, was parsed apart:
/// nlohmann::ordered_json takes quadratic time for it.
struct SplitJson {
    nlohmann::ordered_json rest;  // the object, this field empty
    nlohmann::json part;          // {name: ...}
};
Result<SplitJson> parseSplitJson(std::string_view text, const std::string& where,
                                 std::string_view name);

/// The message of an exception of the JSON library, without its prefix
/// "[json.exception.type_error.302] ".
std::string plainReason(const std::exception& error);

/// A finite number, written as one or as a string ("0.5"); data sets have both.
std::optional<double> numberIn(const nlohmann::json& value);

/// The list under this key; nothing where there is none.
const nlohmann::json::array_t& listIn(const nlohmann::json& object, const char* key);

/// The text under this key, clean; empty where there is none.
std::string textIn(const nlohmann::json& object, const char* key);

}  // namespace dollytrack
