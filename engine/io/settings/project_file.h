#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace dollytrack {

/// The content of a .dolly project file: the scene's path, the parameters, the manual edits and the
/// plan, as JSON. Unknown sections are kept.
struct ProjectFile {
    static constexpr int kVersion = 2;

    std::filesystem::path scene;  // absolute after loading; written relative to the project file
    std::string scene_sha256;     // of the scene file when it was planned
    nlohmann::json import = nlohmann::json::object();      // see import_settings.h
    nlohmann::json parameters = nlohmann::json::object();  // sections of fields
    nlohmann::json edits = nlohmann::json::object();       // see document/edits_json.h
    nlohmann::json result;                                 // null before planning; see plan_json.h
    nlohmann::json others = nlohmann::json::object();      // unknown sections
    std::string file_sha256;  // of the project file itself; empty if it was not read from a file
};

/// Reads a project file. Error: BadInput (missing, not JSON, not a project, of a later version),
/// with file and line.
Result<ProjectFile> loadProject(const std::filesystem::path& path);

/// The text that saveProject() writes to `path`, to which the scene's path is relative. Error:
/// CannotWrite, for a plan that loadProject() would refuse.
Result<std::string> projectText(const ProjectFile& project, const std::filesystem::path& path);

/// Writes a project file atomically. Errors: CannotWrite, also those of projectText().
Status saveProject(const ProjectFile& project, const std::filesystem::path& path);

}  // namespace dollytrack
