#pragma once

#include "engine/core/result.h"
#include "engine/document/project_state.h"
#include "engine/io/project_file.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"

#include <filesystem>
#include <memory>
#include <optional>
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

/// Opens a scene file or a project. `scene_instead` takes the place of a project's own scene file,
/// when that has moved. Errors as io::loadProject() and importScene(); BadInput for parameters that
/// do not fit.
Result<OpenedProject> openProject(const std::filesystem::path& path,
                                  const std::optional<std::filesystem::path>& scene_instead,
                                  const JobContext& job);

/// Whether the path names a project rather than a scene.
[[nodiscard]] bool isProjectFile(const std::filesystem::path& path);

}  // namespace dollytrack::editor
