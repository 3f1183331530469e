#include "app/cli/command_line.h"
#include "app/cli/comparison.h"
#include "app/cli/metrics_table.h"
#include "app/cli/scene_arguments.h"
#include "engine/core/log.h"
#include "engine/io/durable_file.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace dollytrack::cli {
namespace {

struct CompareArguments {
    SceneArguments each;  // how to read and plan every scene; its path is set in turn
    std::vector<std::string> scenes;
    std::vector<std::string> planners = {"all"};
    std::string csv;
    int seeds = 1;
    bool as_json = false;
    bool bound = false;
    bool list = false;
};

nlohmann::ordered_json rowsJson(const ComparedScene& scene) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    const auto& metrics = planning::judgedMetrics();
    for (const ComparedRow& row : scene.rows) {
        nlohmann::ordered_json one = {{"planner", row.planner}};
        for (std::size_t i = 0; i < metrics.size(); ++i) {
            nlohmann::ordered_json value;  // null where the metric does not apply
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

Result<ExitCode> runCompare(const CompareArguments& arguments, const Session& session) {
    if (arguments.list) return listPlanners();
    if (arguments.scenes.empty())
        return fail(ErrorCode::Usage, "Name at least one scene.", "SCENE");
    auto planners = planning::choosePlanners(arguments.planners);
    if (!planners) return tl::unexpected<Error>(std::move(planners.error()));
    const ComparisonOrder order{std::move(*planners), arguments.seeds, arguments.bound};
    const JobContext job = session.job();
    std::vector<ComparedScene> compared;
    int failures = 0;
    Error last;
    for (std::size_t i = 0; i < arguments.scenes.size(); ++i) {
        const auto count = static_cast<double>(arguments.scenes.size());
        const std::string& path = arguments.scenes[i];
        const JobContext part =
            job.stage(static_cast<double>(i) / count, static_cast<double>(i + 1) / count, path);
        SceneArguments one = arguments.each;
        one.path = path;
        Result<ComparedScene> scene =
            openScene(one, part.stage(0.0, 0.1, "loading")).and_then([&](const auto& opened) {
                return compareIn(opened.scene, opened.plan_edits, opened.params, order, {},
                                 part.stage(0.1, 1.0, "comparing"));
            });
        if (!scene) {
            // What is wrong with the command, or stops it, concerns all scenes alike.
            const ErrorCode code = scene.error().code;
            if (code == ErrorCode::Cancelled || code == ErrorCode::Usage) {
                return tl::unexpected<Error>(std::move(scene.error()));
            }
            last = scene.error();
            if (arguments.scenes.size() > 1) log::error("compare", path + ": " + describe(last));
            ++failures;
            continue;
        }
        failures += scene->failures;
        compared.push_back(std::move(*scene));
    }
    if (compared.empty()) return tl::unexpected<Error>(std::move(last));
    if (!arguments.csv.empty()) {
        if (Status status = io::writeWhole(arguments.csv, comparisonCsv(compared)); !status) {
            return tl::unexpected<Error>(std::move(status.error()));
        }
    }
    if (arguments.as_json) {
        fmt::print("{}\n", comparisonJson(compared, order));
    } else {
        for (const ComparedScene& scene : compared) fmt::print("{}\n", comparisonTable(scene));
        if (compared.size() > 1) fmt::print("{}", comparisonTable(meanOver(compared)));
    }
    return failures == 0 ? kDone : kPartial;
}

}  // namespace

void addCompareCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "compare", "Plan with several published methods and judge all trajectories alike");
    auto arguments = std::make_shared<CompareArguments>();
    arguments->each.max_frames = 300;
    command->add_option("scenes", arguments->scenes, "Scenes or .dolly projects")
        ->type_name("SCENE...");
    command
        ->add_option("--planners", arguments->planners,
                     "Which, separated by commas; 'all' by default, --list says what there is")
        ->delimiter(',')
        ->type_name("NAMES");
    command->add_flag("--list", arguments->list, "List the planners and where they come from");
    addImportArguments(*command, arguments->each);
    addParameterArguments(*command, arguments->each);
    command->add_option("--seeds", arguments->seeds, "Plan with this many seeds and give medians")
        ->check(CLI::Range(1, 1000))
        ->type_name("N");
    command->add_flag("--bound", arguments->bound,
                      "Also search densely for what could be captured at all (takes a while)");
    command->add_flag("--json", arguments->as_json, "Print everything as JSON");
    command->add_option("--csv", arguments->csv, "Write everything as a table")->type_name("FILE");
    command->footer(
        "Rates are in %. 'hit frames' have a surface inside the camera's sphere, 'hit moves' meet\n"
        "one on the way to the next frame. Where no motion joins the frames there is no path.\n"
        "Example: dollytrack compare room.glb --planners all --max-frames 300 --bound");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runCompare(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
