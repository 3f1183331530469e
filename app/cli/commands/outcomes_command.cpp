#include "app/cli/commands/outcomes_command.h"

#include "app/cli/compare/comparison.h"
#include "app/outcomes/outcome_run.h"
#include "engine/io/files/durable_file.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <thread>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;
using outcomes::JudgeOutcome;
using outcomes::JudgeProgram;
using outcomes::OutcomeOrder;
using outcomes::OutcomeReport;

/// Converts "320x240" to the assignments of width_px and height_px.
Result<std::vector<std::string>> sizeAssignments(const std::string& text) {
    int width = 0;
    int height = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, width);
    const bool parted = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
    const auto second = parted ? std::from_chars(first.ptr + 1, end, height) : first;
    if (!parted || second.ec != std::errc() || second.ptr != end) {
        return fail(ErrorCode::Usage, "Give the size of the frames as WIDTHxHEIGHT, like 320x240.",
                    "--resolution " + text);
    }
    return std::vector{fmt::format("width_px={}", width), fmt::format("height_px={}", height)};
}

/// Arguments with which `export` reads and plans a scene in this way. Seed and number of frames are
/// added by the caller.
std::vector<std::string> exportArguments(const SceneArguments& each) {
    std::vector<std::string> words;
    const auto add = [&](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    if (each.unit_m) add("--unit", fmt::format("{}", *each.unit_m));
    if (each.up_axis) add("--up", *each.up_axis);
    if (each.labels) add("--labels", fs::absolute(*each.labels).string());
    for (const std::string& folder : each.models) add("--models", fs::absolute(folder).string());
    if (each.annotations) add("--annotations", fs::absolute(*each.annotations).string());
    if (each.keep_meshes) words.emplace_back("--keep-meshes");
    if (each.convert) words.emplace_back("--convert");
    for (const std::string& assignment : each.assignments) add("--set", assignment);
    for (const std::string& assignment : each.cloud) add("--cloud", assignment);
    if (each.max_length_m) add("--max-length", fmt::format("{}", *each.max_length_m));
    if (each.fps) add("--fps", fmt::format("{}", *each.fps));
    if (each.duration_s) add("--duration", fmt::format("{}", *each.duration_s));
    for (const std::string& pattern : each.ignore) add("--ignore", pattern);
    for (const std::string& pattern : each.only) add("--only", pattern);
    if (!each.start.empty()) add("--start", each.start);
    if (!each.end.empty()) add("--end", each.end);
    if (each.loop) words.emplace_back("--loop");
    return words;
}

/// The --judge-option values, grouped by judge.
Result<nlohmann::ordered_json> judgeOptions(const OutcomeArguments& arguments) {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    for (const std::string& text : arguments.options) {
        const std::size_t dot = text.find('.');
        const std::size_t equals = text.find('=');
        if (dot == 0 || dot == std::string::npos || equals == std::string::npos ||
            dot + 1 >= equals) {
            return fail(ErrorCode::Usage,
                        "Give an option of an evaluation program (a judge) as JUDGE.NAME=VALUE.",
                        "--judge-option " + text);
        }
        const std::string name = text.substr(dot + 1, equals - dot - 1);
        if (name == "programs") {
            return fail(ErrorCode::Usage, "Name programs with --slam NAME=COMMAND.",
                        "--judge-option " + text);
        }
        all[text.substr(0, dot)][name] = text.substr(equals + 1);
    }
    return all;
}

/// The --slam programs, grouped by judge.
Result<nlohmann::ordered_json> judgePrograms(const OutcomeArguments& arguments) {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    std::set<std::string> names;
    for (const std::string& text : arguments.slam) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos || equals + 1 == text.size() ||
            !names.insert(text.substr(0, equals)).second) {
            return fail(
                ErrorCode::Usage,
                "Name each SLAM program once, as NAME=COMMAND with {rgbd_folder} and {out}.",
                "--slam " + text);
        }
        all["slam"].push_back(
            {{"name", text.substr(0, equals)}, {"command", text.substr(equals + 1)}});
    }
    return all;
}

Result<std::vector<JudgeProgram>> judgesOf(const OutcomeArguments& arguments) {
    Result<fs::path> own = outcomes::judgesFolder();
    if (!own) return tl::unexpected(std::move(own.error()));
    std::vector<fs::path> folders = {std::move(*own)};
    folders.insert(folders.end(), arguments.folders.begin(), arguments.folders.end());
    return outcomes::findJudges(folders).and_then(
        [&](const auto& all) { return outcomes::chooseJudges(all, arguments.judges); });
}

Status checkOptionNames(const nlohmann::ordered_json& options,
                        const std::vector<JudgeProgram>& judges) {
    for (const auto& [name, values] : options.items()) {
        if (std::ranges::any_of(judges, [&](const auto& one) { return one.name == name; }))
            continue;
        return fail(ErrorCode::Usage,
                    "The options are for a judge that is not in --outcomes; add it there.", name);
    }
    return {};
}

/// Refuses parameters that the comparison sets itself for every export.
Status checkAssignments(const std::vector<std::string>& assignments) {
    for (const std::string& text : assignments) {
        const char* instead = nullptr;
        if (text.starts_with("max_frames=")) {
            instead = "With --outcomes, set the number of frames with --max-frames N.";
        } else if (text.starts_with("seed=")) {
            instead = "With --outcomes, set the first seed with --seed N.";
        } else if (text == "rooms=each") {
            instead = "With --outcomes, every scene must become one dataset; leave out rooms=each.";
        }
        if (instead != nullptr) return fail(ErrorCode::Usage, instead, "--set " + text);
    }
    return {};
}

Result<OutcomeOrder> orderOf(const OutcomeArguments& arguments, const OutcomeSubjects& subjects,
                             const Session& session) {
    OutcomeOrder order;
    if (arguments.out.empty()) {
        return fail(ErrorCode::Usage, "Give the folder for frames and results with --out DIR.",
                    "--out");
    }
    if (Status status = checkAssignments(subjects.each.assignments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    order.folder = fs::absolute(arguments.out).lexically_normal();
    std::vector<std::string> paths = subjects.scenes;
    paths.insert(paths.end(), arguments.test_scenes.begin(), arguments.test_scenes.end());
    const std::vector<std::string> names = sceneNames(paths);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (std::count(names.begin(), names.end(), names[i]) > 1) {
            return fail(ErrorCode::Usage,
                        "Another scene has the same file and folder name; rename one of them.",
                        paths[i]);
        }
        (i < subjects.scenes.size() ? order.scenes : order.test_scenes)
            .push_back({names[i], paths[i]});
    }
    order.planners = subjects.planners;
    order.seeds = subjects.seeds;
    order.first_seed = subjects.each.seed.value_or(1);
    order.each = subjects.each;
    Result<std::vector<std::string>> size = sizeAssignments(arguments.resolution);
    if (!size) return tl::unexpected(std::move(size.error()));
    // Inserted first, so that user settings take precedence. max_repeat_rate=1 keeps our planner
    // from using fewer frames than the others, since all planners need the same number.
    size->emplace_back("max_repeat_rate=1");
    order.each.assignments.insert(order.each.assignments.begin(), size->begin(), size->end());
    order.export_arguments = exportArguments(order.each);
    const int frames = subjects.each.max_frames.value_or(0);
    if (frames > 0) order.frames = frames;  // 0: the default number
    order.test_frames = arguments.test_frames;
    order.controls = arguments.controls;
    order.timeout_s = arguments.timeout_s;
    Result<std::vector<JudgeProgram>> judges = judgesOf(arguments);
    if (!judges) return tl::unexpected(std::move(judges.error()));
    order.judges = std::move(*judges);
    Result<nlohmann::ordered_json> options = judgeOptions(arguments);
    if (!options) return tl::unexpected(std::move(options.error()));
    Result<nlohmann::ordered_json> programs = judgePrograms(arguments);
    if (!programs) return tl::unexpected(std::move(programs.error()));
    for (const auto* by_judge : {&*options, &*programs}) {
        if (Status status = checkOptionNames(*by_judge, order.judges); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    order.options = std::move(*options);
    order.programs = std::move(*programs);
    const auto cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
    order.threads = session.threads > 0 ? session.threads : cores;
    order.version = DOLLYTRACK_VERSION;
    return order;
}

bool hasValue(const outcomes::Row& row) {
    return std::ranges::any_of(row.values, [](const auto& value) { return value.has_value(); });
}

/// Whether every judge has measured every entry. Judges with missing dependencies count only if
/// they were named.
bool isComplete(const OutcomeReport& report, const std::vector<std::string>& named) {
    const bool frames = std::ranges::none_of(
        report.entries, [](const auto& entry) { return entry.dataset.empty(); });
    return frames && std::ranges::all_of(report.judges, [&](const JudgeOutcome& outcome) {
               const bool wanted = std::ranges::find(named, outcome.judge) != named.end();
               if (outcome.state == "missing") return !wanted;
               return outcome.state == "done" && std::ranges::all_of(outcome.rows, hasValue);
           });
}

Status writeReports(const OutcomeReport& report, const fs::path& folder) {
    for (const auto& [name, text] : {std::pair("outcomes.csv", outcomes::outcomeCsv(report)),
                                     std::pair("outcomes.json", outcomes::outcomeJson(report)),
                                     std::pair("outcomes.html", outcomes::outcomeHtml(report))}) {
        if (Status status = writeWhole(folder / name, text); !status) return status;
    }
    return {};
}

}  // namespace

void addOutcomeArguments(CLI::App& command, OutcomeArguments& arguments) {
    command
        .add_option(
            "--outcomes", arguments.judges,
            "Run these judges (or 'all') on every planner's frames; with --list: show which "
            "are installed")
        ->delimiter(',')
        ->type_name("NAMES");
    command.add_option("--out", arguments.out, "Folder for frames and results of --outcomes")
        ->type_name("DIR");
    command
        .add_option("--resolution", arguments.resolution, "Size of the frames of --outcomes, px")
        ->type_name("WxH")
        ->capture_default_str();
    command.add_flag("--controls", arguments.controls,
                     "Also measure two controls: the first planner again (must be equal) and a "
                     "camera that stares at a wall (must score worst)");
    command
        .add_option(
            "--slam", arguments.slam,
            "SLAM program to run, as a shell command with {rgbd_folder}, {out}, {settings}, "
            "{camera}; repeatable")
        ->type_name("NAME=COMMAND")
        ->allow_extra_args(false);
    command
        .add_option("--judge-option", arguments.options,
                    "Option of one judge, such as sfm.every=3; repeatable")
        ->type_name("JUDGE.NAME=VALUE")
        ->allow_extra_args(false);
    command
        .add_option("--judge-timeout", arguments.timeout_s, "Time limit of each judge, s; 0: none")
        ->check(CLI::Range(0.0, 1e9).description("0 .. 1e9"))
        ->type_name("SECONDS");
    command.add_option("--judges", arguments.folders, "Folder with additional judges; repeatable")
        ->type_name("DIR")
        ->allow_extra_args(false);
    command
        .add_option("--test-scene", arguments.test_scenes,
                    "Scene that is used only for test views, without planning in it; repeatable")
        ->type_name("SCENE")
        ->allow_extra_args(false);
    command
        .add_option("--test-frames", arguments.test_frames,
                    "Number of frames in each set of test views")
        ->check(CLI::Range(1, 100'000))
        ->type_name("N")
        ->capture_default_str();
}

Result<ExitCode> runOutcomes(const OutcomeArguments& arguments, const OutcomeSubjects& subjects,
                             const Session& session) {
    const Result<OutcomeOrder> order = orderOf(arguments, subjects, session);
    if (!order) return tl::unexpected(order.error());
    const Result<OutcomeReport> report = outcomes::measureOutcomes(*order, session.job());
    if (!report) return tl::unexpected(report.error());
    // Printed before writing files, so that a full disk does not lose the results.
    fmt::print("{}",
               subjects.as_json ? outcomes::outcomeJson(*report) : outcomes::outcomeText(*report));
    if (Status status = writeReports(*report, order->folder); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    return isComplete(*report, arguments.judges) ? kDone : kPartial;
}

Result<ExitCode> listOutcomes(const OutcomeArguments& arguments, const Session& session) {
    const Result<std::vector<JudgeProgram>> judges = judgesOf(arguments);
    if (!judges) return tl::unexpected(judges.error());
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    if (error) return tl::unexpected(writeError(error.value(), "TMPDIR"));
    std::string name = (parent / "dollytrack-judges-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        return tl::unexpected(writeError(errno, name));
    }
    const fs::path folder = name;
    Status status;
    for (const JudgeProgram& judge : *judges) {
        const auto end = outcomes::checkJudge(judge, {folder, 0.0}, {}, session.job());
        if (!end) {
            status = tl::unexpected(end.error());
            break;
        }
        using How = outcomes::JudgeEnd::How;
        const char* state = end->how == How::Done      ? "found"
                            : end->how == How::Missing ? "missing"
                                                       : "failed";
        fmt::print("{:<18} {}\n{:<18}   {}: {}\n", judge.name, judge.text, "", state, end->text);
    }
    fs::remove_all(folder, error);
    if (!status) return tl::unexpected(std::move(status.error()));
    return kDone;
}

}  // namespace dollytrack::cli
