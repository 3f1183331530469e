#pragma once

#include "app/project/read_project.h"
#include "engine/core/result.h"
#include "engine/document/project_state.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// An opened project: from a .dolly file, or new from a scene file.
struct OpenedProject {
    std::filesystem::path project;  // empty: never saved
    std::filesystem::path scene_file;
    std::shared_ptr<const Scene> imported;
    ProjectState state;
    nlohmann::json import = nlohmann::json::object();
    nlohmann::json loaded_edits = nlohmann::json::object();  // as read, to preserve unknown keys
    nlohmann::json others = nlohmann::json::object();        // other sections, preserved when
                                                             // saving
    std::string file_sha256;                                 // SHA-256 of the project file; empty:
                                                             // never saved
    bool file_has_plan = false;                              // the file contains a plan for this
                                                             // scene file
    std::vector<std::string> warnings;                       // messages for the user
};

/// Imports the scene of a project. Errors: those of importSceneOf() and numberEdits().
Result<OpenedProject> openProject(ProjectContent content, const JobContext& job);

}  // namespace dollytrack::editor
