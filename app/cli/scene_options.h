#pragma once

namespace CLI {
class App;
}

namespace dollytrack::cli {

struct SceneArguments;

/// Adds the positional argument `scene` and all options that addImportArguments() adds.
void addSceneArguments(CLI::App& command, SceneArguments& arguments);
/// Adds --unit, --up, --labels, --models, --annotations, --keep-meshes, --convert and --cloud: the
/// part of addSceneArguments() for commands that take several scenes.
void addImportArguments(CLI::App& command, SceneArguments& arguments);
/// Adds --set.
void addSetArgument(CLI::App& command, SceneArguments& arguments);
/// Adds --set, --seed, --max-frames, --max-length, --fps, --duration, --ignore, --only, --start,
/// --end and --loop.
void addParameterArguments(CLI::App& command, SceneArguments& arguments);

}  // namespace dollytrack::cli
