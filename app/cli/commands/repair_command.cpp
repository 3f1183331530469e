#include "app/cli/command_line.h"
#include "app/cli/given_trajectory.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/scene_arguments.h"
#include "app/cli/scene_options.h"
#include "app/cli/terminal/output_file.h"
#include "app/project/read_project.h"
#include "engine/core/clean_text.h"
#include "engine/core/log.h"
#include "engine/io/settings/project_file.h"
#include "planning/baselines/baseline_scene.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/camera_moves.h"
#include "planning/motions/key_motion.h"
#include "planning/motions/repair_motion.h"
#include "planning/timing/motion_limits.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace dollytrack::cli {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

struct RepairArguments {
    SceneArguments scene;
    std::string trajectory;
    TrajectoryArguments reading;
    std::string move;
    std::string keys;
    std::string out;
    bool no_repair = false;
    bool append = false;
    bool as_json = false;

    /// The project to write.
    [[nodiscard]] const std::string& project() const { return out.empty() ? scene.path : out; }
};

/// A motion to store, and what was changed to make it; empty if it was stored as it is.
struct ImportedMotion {
    GivenMotion motion;
    std::optional<planning::MotionChange> change;
    std::vector<PassedKey> passed = {};  // how the camera passes its keys
};

Status checkUsage(const RepairArguments& arguments) {
    const int sources =
        !arguments.trajectory.empty() + !arguments.move.empty() + !arguments.keys.empty();
    if (sources > 1) {
        return fail(ErrorCode::Usage, "Give only one of --trajectory, --keys and --move.");
    }
    if (arguments.no_repair && arguments.trajectory.empty()) {
        return fail(ErrorCode::Usage,
                    "It needs a --trajectory; what is repaired or made is always collision-free.",
                    "--no-repair");
    }
    if (arguments.append && arguments.move.empty()) {
        return fail(ErrorCode::Usage, "It needs a --move, whose keys follow those of the project.",
                    "--append");
    }
    if (arguments.out.empty() && !isProjectFile(arguments.scene.path)) {
        return fail(ErrorCode::Usage, "A scene file is never changed; give a new project with -o.",
                    arguments.scene.path);
    }
    if (!isProjectFile(arguments.project())) {
        return fail(ErrorCode::Usage, "A project's name must end in .dolly.", arguments.out);
    }
    return checkWritable(arguments.project());
}

/// Refuses a trajectory that passes none of the rooms, and warns if hardly any frame is in one.
Status checkPlace(const std::string& file, const Trajectory& trajectory,
                  const planning::FreeSpace& free_space) {
    constexpr double kNear_m = 0.5;
    constexpr double kMost = 0.5;
    const auto& frames = trajectory.frames;
    const auto isNear = [&](const TrajectoryFrame& frame) {
        return std::ranges::any_of(free_space.rooms(), [&](const planning::Room& room) {
            return room.box.exteriorDistance(frame.pose.position) <= kNear_m;
        });
    };
    if (std::ranges::none_of(frames, isNear)) {
        const Eigen::Vector3d& at = frames.front().pose.position;
        return fail(
            ErrorCode::BadInput,
            fmt::format("None of its poses is in a room of the scene (the first is at {:.2f}, "
                        "{:.2f}, {:.2f} m); positions must be in metres, and the axes those of "
                        "--trajectory-world.",
                        at.x(), at.y(), at.z()),
            file);
    }
    const auto outside = std::ranges::count_if(frames, [&](const TrajectoryFrame& frame) {
        return free_space.componentAt(frame.pose.position) < 0;
    });
    if (static_cast<double>(outside) >= kMost * static_cast<double>(frames.size())) {
        log::warn("repair", fmt::format("{}: {} of {} poses are in obstacles or outside the rooms; "
                                        "check that it belongs to this scene, and its axes "
                                        "(--trajectory-world)",
                                        file, outside, frames.size()));
    }
    return {};
}

/// Names the frame, counted from 0, or the key, counted from 1.
Error errorOf(const MotionFault& fault, const GivenMotion& motion, const std::string& name) {
    if (!fault.frame) return {ErrorCode::BadInput, fault.text, name};
    return {ErrorCode::BadInput, fault.text,
            motion.keys.empty() ? fmt::format("{}, frame {}", name, *fault.frame)
                                : fmt::format("{}, key {}", name, *fault.frame + 1)};
}

Result<ImportedMotion> repairGiven(const GivenMotion& given, const OpenedScene& opened,
                                   const planning::MappedScene& map, const JobContext& job) {
    return planning::repairMotion(map, opened.params, trajectoryOf(given), job)
        .map([&](const planning::RepairedMotion& repaired) {
            return ImportedMotion{givenMotion(given.name, repaired.trajectory), repaired.change};
        });
}

Result<ImportedMotion> importTrajectory(const RepairArguments& arguments, const OpenedScene& opened,
                                        const planning::MappedScene& map, const JobContext& job) {
    const std::string& file = arguments.trajectory;
    const auto loaded = loadGivenTrajectory(file, arguments.reading, opened, "repair");
    if (!loaded) return tl::unexpected(loaded.error());
    if (loaded->trajectory.frames.empty()) {
        return fail(ErrorCode::BadInput, "The trajectory has no poses.", file);
    }
    if (Status status = checkPlace(file, loaded->trajectory, *map.free_space); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const std::string name = cleanText(std::filesystem::path(file).filename().string());
    GivenMotion given = givenMotion(name, loaded->trajectory);
    if (const auto fault = findFault(given)) return tl::unexpected(errorOf(*fault, given, file));
    if (arguments.no_repair) return ImportedMotion{std::move(given), {}};
    return repairGiven(given, opened, map, job);
}

/// The keys as a motion, with how the camera passes them.
Result<ImportedMotion> passKeys(GivenMotion motion, const OpenedScene& opened,
                                const planning::MappedScene& map, const JobContext& job) {
    return planning::moveThroughKeys(map, opened.params.timing, motion.keys, job)
        .map([&](const planning::KeyMotion& made) {
            return ImportedMotion{std::move(motion), {}, made.passed};
        });
}

/// Reads key frames. Without times in the file they follow as fast as the limits allow.
Result<ImportedMotion> importKeys(const RepairArguments& arguments, const OpenedScene& opened,
                                  const planning::MappedScene& map, const JobContext& job) {
    const std::string& file = arguments.keys;
    const auto loaded = loadGivenTrajectory(file, arguments.reading, opened, "repair");
    if (!loaded) return tl::unexpected(loaded.error());
    if (loaded->trajectory.frames.empty()) {
        return fail(ErrorCode::BadInput, "The file has no poses.", file);
    }
    if (Status status = checkPlace(file, loaded->trajectory, *map.free_space); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    GivenMotion motion;
    motion.name = cleanText(std::filesystem::path(file).filename().string());
    for (const MotionFrame& frame : givenMotion({}, loaded->trajectory).frames) {
        motion.keys.push_back({frame.time_s, frame.pose});
    }
    if (const auto fault = findFault(motion)) return tl::unexpected(errorOf(*fault, motion, file));
    if (!loaded->timed) {
        const planning::TimingParams& timing = opened.params.timing;
        const auto times = planning::keyTimes(motion.keys, planning::motionLimits(timing),
                                              1.0 / timing.frame_rate, job);
        if (!times) return tl::unexpected(times.error());
        for (std::size_t i = 0; i < times->size(); ++i) motion.keys[i].time_s = (*times)[i];
    }
    return passKeys(std::move(motion), opened, map, job);
}

/// Gives the keys of the project the times at which the camera reaches them.
Result<ImportedMotion> fitKeys(const OpenedScene& opened, const planning::MappedScene& map,
                               const JobContext& job) {
    GivenMotion fitted = *opened.plan_edits.motion;
    auto keys = planning::withReachableTimes(map, opened.params.timing, std::move(fitted.keys),
                                             job.stage(0.0, 0.8, "key times"));
    if (!keys) return tl::unexpected(std::move(keys.error()));
    fitted.keys = std::move(*keys);
    return passKeys(std::move(fitted), opened, map, job.stage(0.8, 1.0, "key frames"));
}

/// Takes a camera move as the whole motion or, with --append, as further keys of the project's
/// motion.
Result<ImportedMotion> takeMove(const RepairArguments& arguments, const Trajectory& move,
                                const OpenedScene& opened, const planning::MappedScene& map,
                                const JobContext& job) {
    if (!arguments.append) {
        return ImportedMotion{givenMotion(cleanText(arguments.move), move),
                              planning::MotionChange{}};
    }
    GivenMotion motion = opened.plan_edits.motion ? *opened.plan_edits.motion : GivenMotion{};
    if (motion.keys.empty() && !motion.frames.empty()) {
        return fail(
            ErrorCode::Usage,
            "The project's camera motion has no key frames to append to; omit --append to replace "
            "it.",
            "--append");
    }
    auto keys =
        planning::withKeysAlong(std::move(motion.keys), move, opened.params.timing,
                                job.stage(0.0, 0.2, "key frames"))
            .and_then([&](std::vector<MotionKey> longer) {
                return planning::withReachableTimes(map, opened.params.timing, std::move(longer),
                                                    job.stage(0.2, 0.7, "key times"));
            });
    if (!keys) return tl::unexpected(std::move(keys.error()));
    motion.keys = std::move(*keys);
    return passKeys(std::move(motion), opened, map, job.stage(0.7, 1.0, "key frames"));
}

Result<ImportedMotion> makeMotion(const RepairArguments& arguments, const OpenedScene& opened,
                                  const JobContext& job) {
    std::optional<planning::MoveRequest> request;
    if (!arguments.move.empty()) {
        auto parsed = planning::parseMove(arguments.move);
        if (!parsed) return tl::unexpected(std::move(parsed.error()));
        request = std::move(*parsed);
    } else if (arguments.trajectory.empty() && arguments.keys.empty() &&
               !opened.plan_edits.motion) {
        return fail(ErrorCode::Usage,
                    "Give a --trajectory, --keys or a --move; there is no camera motion to repair "
                    "again.");
    }
    const auto map = planning::mapScene(opened.scene, opened.plan_edits, opened.params,
                                        job.stage(0.0, 0.3, "free space"));
    if (!map) return tl::unexpected(map.error());
    const JobContext part = job.stage(0.3, 1.0, "repairing");
    Result<ImportedMotion> made = ImportedMotion{};
    if (request) {
        made = planning::makeMove(*map, opened.params, *request, part.stage(0.0, 0.6, "move"))
                   .and_then([&](const planning::CameraMove& move) {
                       if (!move.note.empty()) log::info("repair", move.note);
                       return takeMove(arguments, move.trajectory, opened, *map,
                                       part.stage(0.6, 1.0, "key frames"));
                   });
    } else if (!arguments.trajectory.empty()) {
        made = importTrajectory(arguments, opened, *map, part);
    } else if (!arguments.keys.empty()) {
        made = importKeys(arguments, opened, *map, part);
    } else if (!opened.plan_edits.motion->keys.empty()) {
        made = fitKeys(opened, *map, part);
    } else {
        made = repairGiven(*opened.plan_edits.motion, opened, *map, part);
    }
    if (!made) return made;
    if (const auto fault = findFault(made->motion)) {
        return tl::unexpected(errorOf(*fault, made->motion, made->motion.name));
    }
    return made;
}

nlohmann::json changeJson(const planning::MotionChange& change) {
    return {{"frames_in_collision", change.frames_in_collision},
            {"moves_in_collision", change.moves_in_collision},
            {"moves_over_limits", change.moves_over_limits},
            {"frames_moved", change.frames_moved},
            {"paths_cut", change.paths_cut},
            {"mean_shift_m", change.mean_shift_m},
            {"largest_shift_m", change.largest_shift_m},
            {"mean_turn_deg", change.mean_turn_rad * kDegreesPerRadian},
            {"largest_turn_deg", change.largest_turn_rad * kDegreesPerRadian},
            {"given_length_m", change.given_length_m},
            {"length_m", change.length_m},
            {"time_added_s", change.time_added_s}};
}

nlohmann::json reportJson(const RepairArguments& arguments, const ImportedMotion& made) {
    const GivenMotion& motion = made.motion;
    nlohmann::json json = {
        {"name", motion.name}, {"duration_s", motion.duration_s()}, {"out", arguments.project()}};
    if (motion.keys.empty()) json["frames"] = motion.frames.size();
    for (std::size_t i = 0; i < made.passed.size(); ++i) {
        const PassedKey& passed = made.passed[i];
        json["keys"].push_back({{"time_s", motion.keys[i].time_s},
                                {"reached_s", passed.time_s},
                                {"note", passed.note}});
    }
    if (made.change) json["change"] = changeJson(*made.change);
    return json;
}

std::string reportText(const RepairArguments& arguments, const ImportedMotion& made) {
    const GivenMotion& motion = made.motion;
    const bool has_keys = !motion.keys.empty();
    std::string text = fmt::format(
        "{}: {} {}, {:.1f} s, stored in {}\n", motion.name.empty() ? "camera path" : motion.name,
        has_keys ? motion.keys.size() : motion.frames.size(), has_keys ? "keys" : "frames",
        motion.duration_s(), arguments.project());
    for (std::size_t i = 0; i < made.passed.size(); ++i) {
        text += fmt::format("  key {:<4} {:8.2f} s  {}\n", i + 1, motion.keys[i].time_s,
                            made.passed[i].note);
    }
    if (!made.change || !arguments.move.empty()) return text;
    const planning::MotionChange& change = *made.change;
    const auto row = [&](const char* title, const std::string& value) {
        text += fmt::format("  {:<22} {}\n", title, value);
    };
    row("frames in collision", std::to_string(change.frames_in_collision));
    row("moves in collision", std::to_string(change.moves_in_collision));
    row("moves over the limits", std::to_string(change.moves_over_limits));
    row("frames moved", std::to_string(change.frames_moved));
    row("shift", fmt::format("{:.3f} m on average, {:.3f} m at most", change.mean_shift_m,
                             change.largest_shift_m));
    row("turn", fmt::format("{:.2f} deg on average, {:.2f} deg at most",
                            change.mean_turn_rad * kDegreesPerRadian,
                            change.largest_turn_rad * kDegreesPerRadian));
    row("length", fmt::format("{:.1f} m, given {:.1f} m", change.length_m, change.given_length_m));
    row("time added",
        fmt::format("{:.2f} s{}", change.time_added_s,
                    change.time_added_s > 0.0 ? ", for the limits of --set motion_preset" : ""));
    return text;
}

Result<ExitCode> runRepair(const RepairArguments& arguments, const Session& session) {
    if (Status status = checkUsage(arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const JobContext job = session.job();
    Result<OpenedScene> opened = openScene(arguments.scene, job.stage(0.0, 0.3, "loading"));
    if (!opened) return tl::unexpected(std::move(opened.error()));
    const auto made = makeMotion(arguments, *opened, job.stage(0.3, 1.0, "motion"));
    if (!made) return tl::unexpected(made.error());
    if (made->change && made->change->paths_cut > 0) {
        log::warn(
            "repair",
            fmt::format(
                "the motion is cut at {} places, because no collision-free path leads across; "
                "check for closed doors",
                made->change->paths_cut));
    }
    opened->edits.plan.motion = made->motion;
    opened->stored_result = nullptr;
    if (Status status = saveProject(projectOf(*opened), arguments.project()); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(reportJson(arguments, *made)));
    } else {
        fmt::print("{}", reportText(arguments, *made));
    }
    return kDone;
}

}  // namespace

void addRepairCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "repair", "Import a camera trajectory, or make a camera move, without collisions");
    auto arguments = std::make_shared<RepairArguments>();
    addSceneArguments(*command, arguments->scene);
    addSetArgument(*command, arguments->scene);
    command
        ->add_option("--trajectory", arguments->trajectory,
                     "Trajectory from another program; it is changed only where the camera would "
                     "collide or exceed the motion limits; default: the project's own motion")
        ->type_name("FILE");
    command
        ->add_option("--keys", arguments->keys,
                     "Instead of a trajectory: key frames, in the same formats; the camera moves "
                     "smoothly through them at their times; if the file has no times, as fast as "
                     "the motion limits allow")
        ->type_name("FILE");
    addTrajectoryArguments(*command, arguments->reading);
    command
        ->add_option("--move", arguments->move,
                     "Instead of a trajectory: a camera move with its options")
        ->type_name("KIND:NAME=VALUE,...");
    command->add_flag("--append", arguments->append,
                      "Add the move after the project's key frames, as keys a second apart, "
                      "instead of replacing them");
    command->add_flag("--no-repair", arguments->no_repair,
                      "Take the trajectory as it is, also where it collides");
    command
        ->add_option("-o,--out", arguments->out,
                     "Project to write, with the motion; default: the given project")
        ->type_name("FILE.dolly");
    command->add_flag("--json", arguments->as_json, "Print what was changed as JSON");
    command->footer(
        planning::moveHelp() +
        "\nExample: dollytrack repair room.glb --trajectory drone.txt -o room.dolly"
        "\nA project with key frames, without further options: gives the keys the times "
        "at which the camera reaches them");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runRepair(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
