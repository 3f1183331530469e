#pragma once

#include "engine/core/result.h"
#include "engine/scene/class_table.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::io {

/// What a label file says: classes of one's own, or more words for NYU40's, or both.
struct LabelFile {
    std::shared_ptr<const ClassTable> classes;  // null: the file keeps to NYU40
    std::string word_lines;                     // as of LabelTable::add()
    std::string word_place;                     // where those are, for errors
};

/// Reads a label file: JSON (it begins with `{`) by assets/schemas/labels.schema.json, else lines
/// of words. Errors: BadInput, a sentence with file and field.
Result<LabelFile> readLabelFile(const std::filesystem::path& path);

/// The table that such JSON describes. `where` names it in errors.
Result<ClassTable> classTableFromJson(const nlohmann::json& content, const std::string& where);

/// The same again: ids, names, colours, patterns and all that was left to defaults.
nlohmann::ordered_json classTableToJson(const ClassTable& table);

}  // namespace dollytrack::io
