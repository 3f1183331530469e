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

/// A project as it is opened: from a .dolly file, or new from a scene file.
struct OpenedProject {
    std::filesystem::path project;  // empty: never saved
    std::filesystem::path scene_file;
    std::shared_ptr<const Scene> imported;
    ProjectState state;
    nlohmann::json import = nlohmann::json::object();
    nlohmann::json loaded_edits = nlohmann::json::object();  // as read, for keys we do not know
    nlohmann::json others = nlohmann::json::object();        // kept when it is saved
    std::string file_sha256;                                 // of the project; empty: never saved
    bool file_has_plan = false;                              // of this scene file
    std::vector<std::string> warnings;                       // what the user should know
};

/// Opens what was read. Errors as importSceneOf().
Result<OpenedProject> openProject(ProjectContent content, const JobContext& job);

}  // namespace dollytrack::editor
