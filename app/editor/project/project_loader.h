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
    nlohmann::json import = nlohmann::json::object();        // settings `imported` was read with
    nlohmann::json loaded_edits = nlohmann::json::object();  // as read, to preserve unknown keys
    nlohmann::json others = nlohmann::json::object();        // other sections of the file
    std::string file_sha256;                                 // of the project file; empty: none
    bool file_has_plan = false;                              // has a plan for this scene file
    std::vector<std::string> warnings;                       // messages for the user
};

/// Imports the scene of a project, or a scene file; Blender files are first converted. Errors:
/// those of convertScene(), importSceneOf() and numberEdits().
Result<OpenedProject> openProject(ProjectContent content, const JobContext& job);

}  // namespace dollytrack::editor
