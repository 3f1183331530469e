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

/// Arguments that name a scene or project and control how it is imported and planned.
struct SceneArguments {
    std::string path;
    std::optional<double> unit_m;
    std::optional<std::string> up_axis;
    std::optional<std::string> labels;
    std::vector<std::string> models;         // folders of --models
    std::optional<std::string> annotations;  // --annotations: a file or a folder
    bool keep_meshes = false;                // --keep-meshes: do not regroup meshes into objects
    bool convert = false;                    // --convert: convert Blender files with Blender
    std::vector<std::string> assignments;    // --set name=value
    std::vector<std::string> cloud;          // --cloud name=value
    std::optional<int> seed;
    std::optional<int> max_frames;
    std::optional<double> max_length_m;
    std::optional<double> fps;
    std::optional<double> duration_s;
    std::vector<std::string> ignore;  // patterns, in addition to the project's
    std::vector<std::string> only;
    std::string start;  // name of a pinned point, or x,y,z,tx,ty,tz (position and target, m)
    std::string end;
    bool loop = false;
    std::optional<double> time_s;  // time of the object tracks
    bool reports_import = false;   // the command itself prints the warnings of the import
    bool one_of_several = false;   // one of several scenes: may lack --ignore and --only names
};

/// An opened scene file or project, with its planning parameters.
struct OpenedScene {
    std::shared_ptr<const Scene> imported;
    std::shared_ptr<const Scene> scene;  // with the edits applied
    planning::PlanParams params;
    Edits edits;                                       // as stored in the project
    PlanEdits plan_edits;                              // with object ids of `scene`
    nlohmann::json import = nlohmann::json::object();  // given settings, such as unit_m, up_axis
    std::string asked_start;  // name of the pinned point given or created by --start; empty: none
    std::string asked_end;
    nlohmann::json stored_result;  // stored plan of the project; null: none, or no longer valid
    nlohmann::json edits_section = nlohmann::json::object();   // edits section as read
    nlohmann::json project_others = nlohmann::json::object();  // other sections of the project
};

/// Applies edits to the imported scene. Edits of missing objects are skipped with a warning. Error:
/// BadInput.
Status applyEdits(OpenedScene& opened, Edits edits);

/// The project to save, with the stored result.
ProjectFile projectOf(const OpenedScene& opened);

/// Names of the planning parameters that differ, for a message: "fill, width_px".
std::string changedNames(const planning::PlanParams& one, const planning::PlanParams& other);

/// A warning for the user, for example "shake_hz has no effect with shake=none; set
/// shake=sinusoidal or handheld"; empty if the parameter has an effect with the current values of
/// the others.
std::string noEffectMessage(const FieldList& fields, const Field& field);

/// Checks that do not need the scene: the file exists, and the parameters are valid. Errors:
/// BadInput, Usage.
[[nodiscard]] Status checkArguments(const SceneArguments& arguments);

/// Imports the scene and applies the parameters: defaults, then the project's, then the command
/// line's. The stored plan is dropped, with a warning, if parameters of the plan, import settings,
/// edits or the scene file differ from those it was made with. Errors: BadInput, Usage, Cancelled.
Result<OpenedScene> openScene(const SceneArguments& arguments, const JobContext& job);

/// A copy of an opened scene with other arguments applied: parameters, objects to ignore, start and
/// end. The file is not read again, so import arguments have no effect. The copy has no stored
/// plan. Errors: BadInput, Usage.
Result<OpenedScene> openedWith(OpenedScene opened, const SceneArguments& arguments);

}  // namespace dollytrack::cli
