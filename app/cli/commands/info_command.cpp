#include "app/cli/command_line.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/scene_arguments.h"
#include "app/cli/scene_options.h"
#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene_report.h"
#include "planning/free_space/free_space.h"
#include "planning/free_space/opening_summary.h"
#include "planning/free_space/surface_coverage.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>

namespace dollytrack::cli {
namespace {

nlohmann::json boxJson(const Eigen::AlignedBox3d& box) {
    const auto list = [](const Eigen::Vector3d& v) {
        return nlohmann::json::array({v.x(), v.y(), v.z()});
    };
    return {{"low_m", list(box.min())}, {"high_m", list(box.max())}};
}

nlohmann::json roomsJson(const planning::FreeSpace& map) {
    nlohmann::json rooms = nlohmann::json::array();
    for (const planning::Room& room : map.rooms()) {
        nlohmann::json one = boxJson(room.box);
        one["room"] = room.component + 1;
        one["volume_m3"] = room.volume_m3;
        one["floor_area_m2"] = room.floor_area_m2;
        one["openings"] = nlohmann::json::array();
        for (const planning::Opening& opening : map.openingReport().openings) {
            if (opening.component == room.component) {
                one["openings"].push_back(planning::describe(opening));
            }
        }
        rooms.push_back(std::move(one));
    }
    return rooms;
}

void printRooms(const planning::FreeSpace& map, double coverage) {
    fmt::print("\nrooms (free space of the camera; rooms joined by open doors are one)\n");
    for (const planning::Room& room : map.rooms()) {
        const Eigen::Vector3d size = room.box.sizes();
        fmt::print("  {:2}  {:.1f} x {:.1f} x {:.1f} m, {:.1f} m2, {:.1f} m3\n", room.component + 1,
                   size.x(), size.y(), size.z(), room.floor_area_m2, room.volume_m3);
    }
    fmt::print("  surfaces are modelled or scanned in {:.0f} % of the directions from inside\n",
               100.0 * coverage);
    if (const std::string scanned = scannedText(map.scannedShare()); !scanned.empty()) {
        fmt::print("  scan: {}\n", scanned);
    }
    for (const std::string& line : planning::describeAll(map.openingReport())) {
        fmt::print("  note: {}\n", line);
    }
}

Result<ExitCode> runInfo(const SceneArguments& arguments, bool as_json, const Session& session) {
    const JobContext job = session.job();
    const auto opened = openScene(arguments, job.stage(0.0, 0.7, "loading"));
    if (!opened) return tl::unexpected(opened.error());
    const RayCaster rays(*opened->scene);
    const auto map =
        planning::FreeSpace::build(*opened->scene, rays, opened->params.camera,
                                   opened->params.free_space, job.stage(0.7, 1.0, "free space"));
    if (!map && map.error().code == ErrorCode::Cancelled) {
        return tl::unexpected(map.error());
    }
    if (as_json) {
        nlohmann::json report = toJson(*opened->scene);
        report["rooms"] = map ? roomsJson(*map) : nlohmann::json::array();
        if (map) {
            report["surface_coverage"] = planning::surfaceCoverage(*opened->scene, rays, *map);
            if (map->scannedShare()) report["scanned_share"] = *map->scannedShare();
        }
        if (!map) report["warnings"].push_back(describe(map.error()));
        fmt::print("{}\n", jsonText(report));
        return kDone;
    }
    fmt::print("{}", describeScene(*opened->scene));
    if (map) {
        printRooms(*map, planning::surfaceCoverage(*opened->scene, rays, *map));
    } else {
        fmt::print("\nwarning: {}\n", describe(map.error()));
    }
    return kDone;
}

}  // namespace

void addInfoCommand(CLI::App& app, Session& session) {
    CLI::App* command =
        app.add_subcommand("info", "Summarize a scene: rooms, objects, classes, doubtful settings");
    auto arguments = std::make_shared<SceneArguments>();
    auto as_json = std::make_shared<bool>(false);
    addSceneArguments(*command, *arguments);
    command->add_flag("--json", *as_json, "Print the summary as JSON");
    command->callback([&session, arguments, as_json] {
        arguments->reports_import = !*as_json;
        session.action = [&session, arguments, as_json] {
            return runInfo(*arguments, *as_json, session);
        };
    });
}

}  // namespace dollytrack::cli
