#pragma once

#include "app/cli/scene_arguments.h"
#include "engine/io/trajectories/trajectory_file.h"

#include <string>

namespace CLI {
class App;
}

namespace dollytrack::cli {

/// How to read the files of the option --trajectory.
struct TrajectoryArguments {
    std::string format;  // empty: detected
    std::string world;   // empty: the format's convention
};

/// Adds --trajectory-format and --trajectory-world.
void addTrajectoryArguments(CLI::App& command, TrajectoryArguments& arguments);

/// Reads a trajectory of another program, in world coordinates of the scene. Logs its format, and a
/// warning if its field of view differs from the camera's. Errors: those of loadTrajectory().
Result<LoadedTrajectory> loadGivenTrajectory(const std::string& path,
                                             const TrajectoryArguments& arguments,
                                             const OpenedScene& opened, std::string_view subsystem);

}  // namespace dollytrack::cli
