#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/io/settings/project_file.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/plan_params.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// What a project says, read and checked; of a scene file that is no project yet, the defaults.
/// Its scene is not imported yet: who opens it may have more to say about that.
struct ProjectContent {
    std::filesystem::path project;  // empty: it is a scene file
    std::filesystem::path scene_file;
    nlohmann::json import =
        nlohmann::json::object();  // how to read the scene, as far as it is said
    planning::PlanParams params;
    Edits edits;
    nlohmann::json result;       // a stored plan; null when there is none
    std::string planned_sha256;  // of the scene file when the project was written
    std::string file_sha256;     // of the project file itself
    nlohmann::json edits_section = nlohmann::json::object();  // as read, for keys we do not know
    nlohmann::json others = nlohmann::json::object();         // what else the file holds
};

/// Whether the path names a project rather than a scene.
[[nodiscard]] bool isProjectFile(const std::filesystem::path& path);

/// A scene file is not looked at, but for the edits in its annotations: `annotations`, or the file
/// beside it (engine/io/settings/annotation_file.h). Errors: as io::loadProject(); BadInput for
/// parameters and edits that do not fit, with the file and the place in it.
Result<ProjectContent> readProject(const std::filesystem::path& path,
                                   const std::optional<std::filesystem::path>& annotations = {});

/// What a project file holds, checked; `path` may be empty where it was never saved.
Result<ProjectContent> contentOf(io::ProjectFile file, const std::filesystem::path& path);

[[nodiscard]] bool sceneIsGone(const ProjectContent& content);

/// Whether importSceneOf() finds a file that it may read. Error: BadInput.
[[nodiscard]] Status checkScene(const ProjectContent& content);

/// Imports the scene file as `import` and the parameters have it. Errors: BadInput when a project's
/// scene is gone; as importScene().
Result<std::shared_ptr<const Scene>> importSceneOf(const ProjectContent& content,
                                                   const JobContext& job);

/// Edits that came with names alone get the numbers of their objects. Returns what was left out.
Result<std::vector<std::string>> numberEdits(ProjectContent& content, const Scene& imported);

/// Whether the scene file is another one than the project was written for.
[[nodiscard]] bool sceneHasChanged(const ProjectContent& content, const Scene& imported);

}  // namespace dollytrack
