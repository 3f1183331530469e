#pragma once

#include "app/cli/command_line.h"
#include "engine/document/edits.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/settings/project_file.h"
#include "engine/scene/scene.h"
#include "planning/plan_params.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {
struct Trajectory;
}

namespace dollytrack::cli {

/// The arguments that name a scene or project and say how to read it.
struct SceneArguments {
    std::string path;
    std::optional<double> unit_m;
    std::optional<std::string> up_axis;
    std::optional<std::string> labels;
    std::vector<std::string> models;         // --models folders
    std::optional<std::string> annotations;  // a file or a folder
    bool keep_meshes = false;                // --keep-meshes: no regrouping
    std::vector<std::string> assignments;    // --set name=value
    std::vector<std::string> cloud;          // --cloud name=value
    std::optional<int> seed;
    std::optional<int> max_frames;
    std::optional<double> max_length_m;
    std::optional<double> fps;
    std::optional<double> duration_s;
    std::vector<std::string> ignore;  // patterns, beside those of the project
    std::vector<std::string> only;
    std::string start;  // a pinned point's name, or x,y,z,tx,ty,tz
    std::string end;
    bool loop = false;
    std::optional<double> time_s;  // of the objects' tracks
    bool one_of_several = false;   // scenes; what one of them lacks another one may have
};

void addSceneArguments(CLI::App& command, SceneArguments& arguments);
/// --unit, --up, --labels, --models, --annotations, --keep-meshes, --cloud: part of the above, for
/// commands that take several scenes.
void addImportArguments(CLI::App& command, SceneArguments& arguments);
/// --set, --seed, --max-frames, --max-length, --fps, --duration; --ignore, --only, --start, --end,
/// --loop
void addParameterArguments(CLI::App& command, SceneArguments& arguments);

/// A scene with the parameters to plan it with, from a scene file or a project.
struct OpenedScene {
    std::shared_ptr<const Scene> imported;
    std::shared_ptr<const Scene> scene;  // with the edits applied
    planning::PlanParams params;
    Edits edits;           // as the project has them
    PlanEdits plan_edits;  // with the numbers that their objects have in the scene
    nlohmann::json import = nlohmann::json::object();  // unit_m, up_axis, labels, ..., where given
    std::string asked_start;  // the pinned point that --start names or made; empty without one
    std::string asked_end;
    nlohmann::json stored_result;  // of a project; null when there is none, or it no longer holds
    nlohmann::json edits_section = nlohmann::json::object();   // as it was read
    nlohmann::json project_others = nlohmann::json::object();  // what else the project holds
};

/// Applies edits to the imported scene; what they name and is gone is warned of. Error: BadInput.
Status applyEdits(OpenedScene& opened, Edits edits);

/// The project that keeps what was opened, with its stored result.
io::ProjectFile projectOf(const OpenedScene& opened);

/// What is wrong that can be told without reading the scene: no such file, or a parameter that is
/// none. Errors: BadInput, Usage.
[[nodiscard]] Status checkArguments(const SceneArguments& arguments);

/// Loads it and applies the parameters: defaults, then the project's, then the command line's.
/// A project's result is dropped, with a note, when the command line changes a parameter or the
/// scene file is another one than was planned. Errors: BadInput, Usage, Cancelled.
Result<OpenedScene> openScene(const SceneArguments& arguments, const JobContext& job);

/// A copy of an opened scene to which other arguments are applied: parameters, objects to ignore,
/// start and end. The file is not read again, so arguments of the import have no effect. The copy
/// has no stored result. Errors: BadInput, Usage.
Result<OpenedScene> openedWith(OpenedScene opened, const SceneArguments& arguments);

}  // namespace dollytrack::cli
