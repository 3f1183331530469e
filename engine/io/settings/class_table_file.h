#pragma once

#include "engine/core/result.h"
#include "engine/scene/class_table.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// The content of a label file: classes for datasets, further words for NYU40's classes, or both.
struct LabelFile {
    std::shared_ptr<const ClassTable> classes;  // null: NYU40's classes
    std::string word_lines;                     // lines for LabelTable::add()
    std::string word_place;                     // their file and field, for errors
};

/// Reads a label file: JSON of assets/schemas/labels.schema.json if it begins with `{`, otherwise
/// lines of words. Error: BadInput, with file and field.
Result<LabelFile> readLabelFile(const std::filesystem::path& path);

/// Reads the class table in the JSON of a label file. `where` is the file, for errors. Error:
/// BadInput.
Result<ClassTable> classTableFromJson(const nlohmann::json& content, const std::string& where);

/// Converts a table to JSON, including all values that were defaults.
nlohmann::ordered_json classTableToJson(const ClassTable& table);

}  // namespace dollytrack
