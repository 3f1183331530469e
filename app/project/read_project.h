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

/// The validated content of a project file; for a scene file, the defaults. The scene is not
/// imported yet: callers may change the import settings first.
struct ProjectContent {
    std::filesystem::path project;  // empty: opened from a scene file
    std::filesystem::path scene_file;
    nlohmann::json import = nlohmann::json::object();  // import settings that were given
    planning::PlanParams params;
    Edits edits;
    nlohmann::json result;       // stored plan; null if there is none
    std::string planned_sha256;  // hash of the scene file when the project was written
    std::string file_sha256;     // hash of the project file
    nlohmann::json edits_section = nlohmann::json::object();  // as read, to preserve unknown keys
    nlohmann::json others = nlohmann::json::object();         // other sections of the file
};

/// The kinds of scene files, for help texts. Blender comes last, because its files must be
/// converted: the command line appends "with --convert".
inline constexpr const char* kSceneFormats =
    "OBJ, FBX, glTF, GLB, DAE, PLY, STL; Gazebo, URDF, Habitat; point clouds; homes; 3D-FRONT, "
    "SceneNet RGB-D; Blender";

/// Whether the path is a project (.dolly) rather than a scene.
[[nodiscard]] bool isProjectFile(const std::filesystem::path& path);

/// Reads a project. For a scene file, reads only the edits in its annotations: those given, or
/// those beside it (engine/io/settings/annotation_file.h). Errors: those of loadProject();
/// BadInput for invalid parameters and edits, with file and location.
Result<ProjectContent> readProject(const std::filesystem::path& path,
                                   const std::optional<std::filesystem::path>& annotations = {});

/// Validates a project file's content; `path` is empty if it was never saved. Error: BadInput.
Result<ProjectContent> contentOf(ProjectFile file, const std::filesystem::path& path);

[[nodiscard]] bool sceneIsGone(const ProjectContent& content);

/// Checks that the scene file exists and has a supported format. Error: BadInput.
[[nodiscard]] Status checkScene(const ProjectContent& content);

/// Imports the scene file with the project's import settings. Errors: BadInput if a project's scene
/// is missing; those of importScene().
Result<std::shared_ptr<const Scene>> importSceneOf(const ProjectContent& content,
                                                   const JobContext& job);

/// For edits from annotations, which name objects only: adds the objects' ids. Returns warnings
/// about edits that were skipped.
Result<std::vector<std::string>> numberEdits(ProjectContent& content, const Scene& imported);

/// Whether the scene file differs from the one that the project was saved for.
[[nodiscard]] bool sceneHasChanged(const ProjectContent& content, const Scene& imported);

}  // namespace dollytrack
