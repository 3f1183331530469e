#include "app/cli/command_line.h"
#include "app/cli/commands/outcomes_command.h"
#include "app/cli/compare/comparison.h"
#include "app/cli/compare/project_comparison.h"
#include "app/cli/given_trajectory.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/scene_arguments.h"
#include "app/cli/scene_options.h"
#include "app/cli/terminal/output_file.h"
#include "engine/core/log.h"
#include "engine/io/files/durable_file.h"
#include "render/plots/figure.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>

namespace dollytrack::cli {
namespace {

struct CompareArguments {
    SceneArguments each;  // import and planning options of every scene; its path is set for each
    std::vector<std::string> scenes;
    std::vector<std::string> projects;  // two, whose plans are compared instead of planners
    std::vector<std::string> planners = {"all"};
    std::vector<std::string> trajectories;
    TrajectoryArguments reading;
    std::string csv;
    std::string picture;
    int seeds = 1;
    bool as_json = false;
    bool bound = false;
    bool list = false;
    OutcomeArguments outcomes;
};

nlohmann::ordered_json rowsJson(const ComparedScene& scene) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    const auto& metrics = planning::plannerMetricInfos();
    for (const ComparedRow& row : scene.rows) {
        nlohmann::ordered_json one = {{"planner", row.planner}};
        for (std::size_t i = 0; i < metrics.size(); ++i) {
            nlohmann::ordered_json value;  // null if the metric does not apply
            if (row.values[i]) value = *row.values[i];
            one[std::string(metrics[i].name)] = std::move(value);
        }
        rows.push_back(std::move(one));
    }
    return rows;
}

std::string comparisonJson(const std::vector<ComparedScene>& scenes, const ComparisonOrder& order) {
    nlohmann::ordered_json json;
    json["seeds"] = order.seeds;
    for (const planning::Planner* planner : order.planners) {
        json["planners"].push_back({{"name", planner->name},
                                    {"text", planner->text},
                                    {"source", planner->source},
                                    {"collision_promise", planner->collision_promise}});
    }
    json["scenes"] = nlohmann::ordered_json::array();
    for (const ComparedScene& scene : scenes) {
        json["scenes"].push_back(
            {{"scene", scene.scene}, {"map_ms", scene.map_ms}, {"rows", rowsJson(scene)}});
    }
    json["mean"] = rowsJson(meanOver(scenes));
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

ExitCode listPlanners() {
    for (const planning::Planner& planner : planning::planners()) {
        fmt::print("{:<18} {}\n{:<18}   from: {}\n{:<18}   collisions: {}\n", planner.name,
                   planner.text, "", planner.source, "", planner.collision_promise);
    }
    return kDone;
}

/// Names of the trajectories in tables: the file name, with its folder and then a number if the
/// name is taken.
std::vector<std::string> givenNames(const std::vector<std::string>& paths) {
    std::vector<std::string> taken = {"bound"};
    for (const planning::Planner& planner : planning::planners()) taken.emplace_back(planner.name);
    const auto isFree = [&](const std::string& name) {
        return std::find(taken.begin(), taken.end(), name) == taken.end();
    };
    std::vector<std::string> names;
    for (const std::string& path : paths) {
        const std::filesystem::path file = std::filesystem::absolute(path).lexically_normal();
        const std::string longer = (file.parent_path().filename() / file.filename()).string();
        std::string name = file.filename().string();
        if (!isFree(name)) name = longer;
        for (int i = 2; !isFree(name); ++i) name = fmt::format("{} ({})", longer, i);
        taken.push_back(name);
        names.push_back(std::move(name));
    }
    return names;
}

/// Reads the --trajectory files, in world coordinates of the scene.
Result<std::vector<ExternalTrajectory>> loadGiven(const CompareArguments& arguments,
                                                  const OpenedScene& opened) {
    std::vector<ExternalTrajectory> given;
    const std::vector<std::string> names = givenNames(arguments.trajectories);
    for (const std::string& path : arguments.trajectories) {
        Result<LoadedTrajectory> loaded =
            loadGivenTrajectory(path, arguments.reading, opened, "compare");
        if (!loaded) return tl::unexpected(std::move(loaded.error()));
        given.push_back({names[given.size()], {std::move(loaded->trajectory), {}, {}, {}}});
    }
    return given;
}

/// Bar charts of the metrics that rank planners.
render::Figure comparisonFigure(const ComparedScene& scene) {
    render::Figure figure;
    figure.title = scene.scene;
    const auto& metrics = planning::plannerMetricInfos();
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        const planning::MetricInfo& metric = metrics[m];
        if (metric.better == planning::Better::Neither) continue;
        const bool rate = metric.unit == "%";
        render::BarChart chart;
        chart.title = fmt::format("{} ({})", metric.name, metric.unit);
        bool any = false;
        for (const ComparedRow& row : scene.rows) {
            chart.names.push_back(row.planner);
            std::optional<double> value = row.values[m];
            if (value && rate) *value *= 100.0;
            any |= value.has_value();
            chart.values.push_back(value);
        }
        if (any) figure.bars.push_back(std::move(chart));
    }
    return figure;
}

/// Refuses options of --outcomes if --outcomes is not given.
Status checkOutcomesGiven(const OutcomeArguments& given) {
    if (!given.judges.empty()) return {};
    const OutcomeArguments usual;
    for (const auto& [differs, option] :
         {std::pair(!given.out.empty(), "--out"),
          std::pair(given.resolution != usual.resolution, "--resolution"),
          std::pair(given.controls, "--controls"), std::pair(!given.slam.empty(), "--slam"),
          std::pair(!given.options.empty(), "--judge-option"),
          std::pair(given.timeout_s != usual.timeout_s, "--judge-timeout"),
          std::pair(!given.folders.empty(), "--judges"),
          std::pair(!given.test_scenes.empty(), "--test-scene"),
          std::pair(given.test_frames != usual.test_frames, "--test-frames")}) {
        if (differs) {
            return fail(ErrorCode::Usage, "It needs --outcomes; name the judges there, or 'all'.",
                        option);
        }
    }
    return {};
}

/// Checks that would otherwise fail only after long work.
Status checkUsage(const CompareArguments& arguments) {
    if (arguments.scenes.empty()) {
        return fail(ErrorCode::Usage, "Give at least one scene.", "SCENE");
    }
    if (!arguments.trajectories.empty() && arguments.scenes.size() > 1) {
        return fail(ErrorCode::Usage, "A trajectory belongs to one scene; give only that scene.",
                    "--trajectory");
    }
    if (!arguments.picture.empty()) {
        if (Status status = render::checkFigureName(arguments.picture); !status) return status;
    }
    if (!arguments.outcomes.judges.empty()) {
        for (const auto& [given, option] :
             {std::pair(!arguments.csv.empty(), "--csv"),
              std::pair(!arguments.picture.empty(), "--picture"),
              std::pair(!arguments.trajectories.empty(), "--trajectory"),
              std::pair(arguments.bound, "--bound")}) {
            if (!given) continue;
            return fail(ErrorCode::Usage,
                        "It cannot be combined with --outcomes; leave out one of the two.", option);
        }
    }
    if (Status status = checkWritable(arguments.csv); !status) return status;
    return checkWritable(arguments.picture);
}

Status writeFiles(const CompareArguments& arguments, const std::vector<ComparedScene>& compared) {
    if (!arguments.csv.empty()) {
        if (Status status = writeWhole(arguments.csv, comparisonCsv(compared)); !status) {
            return status;
        }
    }
    if (arguments.picture.empty()) return {};
    return render::writeFigure(
        comparisonFigure(compared.size() == 1 ? compared.front() : meanOver(compared)),
        arguments.picture);
}

/// Sets the frame budget to 300 unless the command line has one: without a common budget, planners
/// are not comparable.
SceneArguments withFrames(SceneArguments each) {
    const auto sets = [](const std::string& text) { return text.starts_with("max_frames="); };
    const bool set = std::ranges::any_of(each.assignments, sets);
    if (!each.max_frames && !set) each.max_frames = 300;
    const bool none = each.max_frames ? *each.max_frames == 0
                                      : std::ranges::find(each.assignments, "max_frames=0") !=
                                            each.assignments.end();
    if (none)
        log::warn("compare",
                  "max_frames=0 does not remove the limit here: every planner gets the frames of "
                  "duration_s, or 300 without it");
    return each;
}

/// Compares the plans of two projects instead of planners.
Result<ExitCode> runProjects(const CompareArguments& arguments, const Session& session) {
    const CompareArguments usual;
    for (const auto& [given, option] :
         {std::pair(!arguments.scenes.empty(), "SCENE"),
          std::pair(arguments.planners != usual.planners, "--planners"),
          std::pair(arguments.seeds != usual.seeds, "--seeds"),
          std::pair(arguments.bound, "--bound"), std::pair(!arguments.picture.empty(), "--picture"),
          std::pair(!arguments.trajectories.empty(), "--trajectory"),
          std::pair(!arguments.outcomes.judges.empty(), "--outcomes")}) {
        if (!given) continue;
        return fail(ErrorCode::Usage,
                    "It cannot be combined with --projects; leave out one of the two.", option);
    }
    if (Status status = checkWritable(arguments.csv); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const auto compared = compareProjects(arguments.projects, arguments.each, session.job());
    if (!compared) return tl::unexpected(compared.error());
    if (arguments.as_json) {
        fmt::print("{}\n", comparisonJson(*compared));
    } else {
        fmt::print("{}", comparisonTable(*compared));
    }
    if (!arguments.csv.empty()) {
        if (Status status = writeWhole(arguments.csv, comparisonCsv(*compared)); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    return kDone;
}

Result<ExitCode> runCompare(const CompareArguments& arguments, const Session& session) {
    const bool outcomes = !arguments.outcomes.judges.empty();
    if (Status status = checkOutcomesGiven(arguments.outcomes); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (arguments.list) {
        return outcomes ? listOutcomes(arguments.outcomes, session) : listPlanners();
    }
    if (!arguments.projects.empty()) return runProjects(arguments, session);
    if (Status status = checkUsage(arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    auto planners = planning::choosePlanners(arguments.planners);
    if (!planners) return tl::unexpected(std::move(planners.error()));
    const ComparisonOrder order{std::move(*planners), arguments.seeds, arguments.bound};
    const SceneArguments each = withFrames(arguments.each);
    if (outcomes) {
        OutcomeSubjects subjects{arguments.scenes, {}, arguments.seeds, each, arguments.as_json};
        for (const planning::Planner* planner : order.planners) {
            subjects.planners.emplace_back(planner->name);
        }
        return runOutcomes(arguments.outcomes, subjects, session);
    }
    const JobContext job = session.job();
    const std::vector<std::string> names = sceneNames(arguments.scenes);
    std::vector<ComparedScene> compared;
    int failures = 0;
    Error last;
    for (std::size_t i = 0; i < arguments.scenes.size(); ++i) {
        const auto count = static_cast<double>(arguments.scenes.size());
        const std::string& path = arguments.scenes[i];
        const JobContext part =
            job.stage(static_cast<double>(i) / count, static_cast<double>(i + 1) / count, path);
        SceneArguments one = each;
        one.path = path;
        one.one_of_several = arguments.scenes.size() > 1;
        Result<ComparedScene> scene =
            openScene(one, part.stage(0.0, 0.1, "loading")).and_then([&](const auto& opened) {
                return loadGiven(arguments, opened).and_then([&](const auto& given) {
                    return compareIn(opened.scene, opened.plan_edits, opened.params, order, given,
                                     part.stage(0.1, 1.0, "comparing"));
                });
            });
        if (!scene) {
            // Usage errors and cancellation affect all scenes.
            const ErrorCode code = scene.error().code;
            if (code == ErrorCode::Cancelled || code == ErrorCode::Usage) {
                return tl::unexpected(std::move(scene.error()));
            }
            last = scene.error();
            if (arguments.scenes.size() > 1) log::error("compare", path + ": " + describe(last));
            ++failures;
            continue;
        }
        failures += scene->failures;
        scene->scene = names[i];
        compared.push_back(std::move(*scene));
    }
    if (compared.empty()) return tl::unexpected(std::move(last));
    // Printed before writing files, so that a full disk does not lose the results.
    if (arguments.as_json) {
        fmt::print("{}\n", comparisonJson(compared, order));
    } else {
        for (const ComparedScene& scene : compared) fmt::print("{}\n", comparisonTable(scene));
        if (compared.size() > 1) fmt::print("{}", comparisonTable(meanOver(compared)));
    }
    if (Status status = writeFiles(arguments, compared); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    return failures == 0 ? kDone : kPartial;
}

}  // namespace

void addCompareCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "compare", "Plan with several published methods and measure all trajectories alike");
    auto arguments = std::make_shared<CompareArguments>();
    command->add_option("scenes", arguments->scenes, "Scenes or .dolly projects")
        ->type_name("SCENE...");
    command
        ->add_option("--projects", arguments->projects,
                     "Compare the plans of two projects of one scene instead of planners")
        ->type_name("A.dolly B.dolly")
        ->expected(2);
    command
        ->add_option("--planners", arguments->planners,
                     "Planners, separated by commas (see --list); default: all")
        ->delimiter(',')
        ->type_name("NAMES");
    command->add_flag("--list", arguments->list, "List the planners and their sources");
    addImportArguments(*command, arguments->each);
    addParameterArguments(*command, arguments->each);
    command->add_option("--seeds", arguments->seeds, "Plan with this many seeds and report medians")
        ->check(CLI::Range(1, 1000))
        ->type_name("N");
    command->add_flag("--bound", arguments->bound,
                      "Also compute an upper bound by a dense viewpoint search (slow)");
    command->add_flag("--json", arguments->as_json, "Print everything as JSON");
    command->add_option("--csv", arguments->csv, "Write all results as a table")->type_name("FILE");
    command
        ->add_option("--picture", arguments->picture,
                     "Bar chart of the results; for several scenes, of their mean")
        ->type_name("FILE.svg|png");
    command
        ->add_option("--trajectory", arguments->trajectories,
                     "Also measure a trajectory from another program; repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false);
    addTrajectoryArguments(*command, arguments->reading);
    addOutcomeArguments(*command, arguments->outcomes);
    command->footer(
        "Rates are in %. In 'hit frames' a surface is inside the camera's sphere; in 'hit moves' "
        "it\ntouches one on the way to the next frame. Planners without motion have no "
        "path.\nExample: dollytrack compare room.glb --planners all --max-frames 300 --bound");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runCompare(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
