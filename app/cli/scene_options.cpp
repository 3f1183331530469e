#include "app/cli/scene_options.h"

#include "app/cli/length_unit.h"
#include "app/cli/scene_arguments.h"
#include "app/project/read_project.h"
#include "engine/core/log.h"
#include "engine/math/up_axis.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace dollytrack::cli {
namespace {

/// Accepts any spelling of an upward axis and normalizes it.
CLI::Validator upAxisOption() {
    return CLI::Validator(
        [](std::string& text) {
            const std::optional<UpAxis> axis = parseUpAxis(text);
            if (!axis) return fmt::format("'{}' is not an upward axis: give {}", text, kUpAxes);
            text = axis->text();
            return std::string();
        },
        "", "upward axis");
}

/// Adds an existing folder, or the folders of a colon-separated list (a folder's own name may
/// contain colons). Missing folders of a list are skipped with a warning.
void addModelFolders(const std::string& text, std::vector<std::string>& folders) {
    const std::string wrong = CLI::ExistingDirectory(text);
    if (wrong.empty()) {
        folders.push_back(text);
        return;
    }
    bool any = false;
    std::vector<std::string> missing;
    for (const std::string& part : CLI::detail::split(text, ':')) {
        if (part.empty()) continue;
        if (CLI::ExistingDirectory(part).empty()) {
            folders.push_back(part);
            any = true;
        } else {
            missing.push_back(part);
        }
    }
    if (!any) throw CLI::ValidationError("--models", wrong);
    for (const std::string& folder : missing) {
        log::warn("import", "--models: there is no folder '" + folder + "'; it is skipped");
    }
}

}  // namespace

void addSceneArguments(CLI::App& command, SceneArguments& arguments) {
    command
        .add_option("scene", arguments.path,
                    fmt::format("Scene ({} with --convert) or .dolly project", kSceneFormats))
        ->required()
        ->type_name("SCENE");
    addImportArguments(command, arguments);
}

void addImportArguments(CLI::App& command, SceneArguments& arguments) {
    command
        .add_option("--unit", arguments.unit_m,
                    "Metres per unit of the scene, or m, cm, mm, inch, ft; default: detected")
        ->transform(lengthUnit())
        ->type_name("METRES|UNIT");
    command
        .add_option("--up", arguments.up_axis,
                    "The scene's upward axis: x, y, z, -x, -y or -z; default: detected")
        ->transform(upAxisOption())
        ->type_name("AXIS");
    command
        .add_option("--labels", arguments.labels,
                    "Words and their NYU40 classes (CSV), added to the built-in ones, or your own "
                    "classes for the dataset (JSON, see assets/labels)")
        ->type_name("FILE");
    command
        .add_option_function<std::vector<std::string>>(
            "--models",
            [&arguments](const std::vector<std::string>& given) {
                arguments.models.clear();
                for (const std::string& text : given) addModelFolders(text, arguments.models);
            },
            "Folder with the models that the scene refers to (3D-FUTURE-model, ShapeNetCore.v2, "
            "Gazebo's models); repeatable, or several separated by colons (\"$GAZEBO_MODEL_PATH\")")
        ->type_name("DIR")
        ->allow_extra_args(false);
    command
        .add_option("--annotations", arguments.annotations,
                    "Annotations of the scene: a file SCENE.objects.json from another folder, "
                    "or the folder of a Hypersim scene (ai_VVV_NNN)")
        ->check(CLI::ExistingPath.description(""))
        ->type_name("FILE|DIR");
    command.add_flag("--keep-meshes", arguments.keep_meshes,
                     "Leave meshes as they are in the file: neither split meshes that contain "
                     "several objects, nor join objects that have one mesh per material");
    command.add_flag("--convert", arguments.convert,
                     "Convert a Blender file (.blend) to glTF beside it with the installed "
                     "Blender, in a sandbox, and use that");
    command
        .add_option("--cloud", arguments.cloud,
                    "Reconstruction of a point cloud: voxel_m, max_points, gap_m, hole_m, plane_m, "
                    "object_m; repeatable")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
}

void addSetArgument(CLI::App& command, SceneArguments& arguments) {
    command
        .add_option("--set", arguments.assignments,
                    "Set a parameter (see 'dollytrack params'); repeatable")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
}

void addParameterArguments(CLI::App& command, SceneArguments& arguments) {
    addSetArgument(command, arguments);
    command.add_option("--seed", arguments.seed, "Same as --set seed=N")->type_name("N");
    command.add_option("--max-frames", arguments.max_frames, "Same as --set max_frames=N")
        ->type_name("N");
    command.add_option("--max-length", arguments.max_length_m, "Same as --set max_length_m=METRES")
        ->type_name("METRES");
    command
        .add_option("--fps", arguments.fps,
                    "Fixed frame rate; same as --set frame_rate=N --set keep_frame_rate=true")
        ->type_name("N");
    command
        .add_option("--duration", arguments.duration_s,
                    "Exact duration; same as --set duration_s=SECONDS")
        ->type_name("SECONDS");
    command
        .add_option("--ignore", arguments.ignore,
                    "A class, or a name with * and ?, that is not a target; repeatable")
        ->type_name("CLASS|NAME")
        ->allow_extra_args(false);
    command.add_option("--only", arguments.only, "The only targets, by class or name; repeatable")
        ->type_name("CLASS|NAME")
        ->allow_extra_args(false);
    command
        .add_option("--start", arguments.start,
                    "Start point: a pinned point, or a position and a point to look at, m")
        ->type_name("POINT|x,y,z,tx,ty,tz");
    command.add_option("--end", arguments.end, "End point, in the form of --start")
        ->type_name("POINT|x,y,z,tx,ty,tz");
    command.add_flag("--loop", arguments.loop, "End at the start; same as --set loop=true");
}

}  // namespace dollytrack::cli
