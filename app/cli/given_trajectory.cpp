#include "app/cli/given_trajectory.h"

#include "engine/core/log.h"
#include "render/formats/poses/camera_json.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>

namespace dollytrack::cli {

void addTrajectoryArguments(CLI::App& command, TrajectoryArguments& arguments) {
    command
        .add_option("--trajectory-format", arguments.format,
                    "Format of --trajectory; default: detected. One of: " + trajectoryFormatNames())
        ->type_name("NAME");
    command
        .add_option("--trajectory-world", arguments.world,
                    "World axes and unit of its positions: scene (those of the scene file), y-up, "
                    "z-up, ned, camera; default: the format's convention")
        ->type_name("NAME");
}

Result<LoadedTrajectory> loadGivenTrajectory(const std::string& path,
                                             const TrajectoryArguments& arguments,
                                             const OpenedScene& opened,
                                             std::string_view subsystem) {
    TrajectoryReading reading;
    reading.format = arguments.format;
    reading.world = arguments.world;
    reading.source_from_world = opened.scene->source_from_world;
    reading.camera_json_from_world = render::cameraJsonFromWorld(*opened.scene);
    reading.interval_s = 1.0 / opened.params.timing.frame_rate;
    Result<LoadedTrajectory> loaded = loadTrajectory(path, reading);
    if (!loaded) return loaded;
    log::info(
        subsystem,
        fmt::format("{}: {} poses, format {}{}", path, loaded->trajectory.frames.size(),
                    loaded->format, loaded->timed ? "" : ", without times: frame_rate is assumed"));
    constexpr double kNoticeable = 0.5;  // larger differences are reported, degrees
    const double hfov = opened.params.camera.hfov_deg;
    if (loaded->hfov_deg && std::abs(*loaded->hfov_deg - hfov) > kNoticeable) {
        log::warn(subsystem,
                  fmt::format("{}: its horizontal field of view is {:.1f} degrees, but it is "
                              "measured with {:.1f}; pass --set hfov_deg={:.1f}",
                              path, *loaded->hfov_deg, hfov, *loaded->hfov_deg));
    }
    return loaded;
}

}  // namespace dollytrack::cli
