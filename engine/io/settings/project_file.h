#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace dollytrack::io {

/// A .dolly file: a scene by reference, the parameters, what was edited by hand, and what planning
/// made of it all. JSON, so that people can read and compare it; sections that this version does
/// not know are kept.
struct ProjectFile {
    static constexpr int kVersion = 2;

    std::filesystem::path scene;  // absolute after loading; written relative to the project file
    std::string scene_sha256;     // of the scene file when it was planned
    nlohmann::json import = nlohmann::json::object();  // how to read it, as far as the user said
    nlohmann::json parameters = nlohmann::json::object();  // sections of fields
    nlohmann::json edits = nlohmann::json::object();       // see document/edits_json.h
    nlohmann::json result;                                 // null before planning; see plan_json.h
    nlohmann::json others = nlohmann::json::object();      // what else the file holds
    std::string file_sha256;  // of the file that it was read from; empty: it was not read
};

/// Errors: BadInput (missing, not JSON, not a project, of a later version), with file and line.
Result<ProjectFile> loadProject(const std::filesystem::path& path);

/// What saveProject() writes; the path of the scene depends on where that is.
[[nodiscard]] std::string projectText(const ProjectFile& project,
                                      const std::filesystem::path& path);

/// Written whole or not at all. Error: CannotWrite.
Status saveProject(const ProjectFile& project, const std::filesystem::path& path);

}  // namespace dollytrack::io
