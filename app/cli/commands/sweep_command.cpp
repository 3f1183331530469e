#include "app/cli/command_line.h"
#include "app/cli/compare/sweep.h"
#include "app/cli/compare/sweep_output.h"
#include "app/cli/scene_options.h"
#include "app/cli/terminal/output_file.h"
#include "engine/core/log.h"
#include "engine/io/files/durable_file.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

namespace dollytrack::cli {
namespace {

constexpr std::size_t kMostCombinations = 10'000;

struct SweepArguments {
    SceneArguments scene;
    std::vector<std::string> parameters;
    std::vector<std::string> metrics;
    std::vector<std::string> planners;
    std::string csv;
    std::string plot;
};

Result<std::vector<SweptParameter>> parseParameters(const std::vector<std::string>& texts) {
    std::vector<SweptParameter> parameters;
    std::size_t combined = 1;
    for (const std::string& text : texts) {
        Result<SweptParameter> one = parseSweptParameter(text);
        if (!one) return tl::unexpected(std::move(one.error()));
        const bool twice =
            std::any_of(parameters.begin(), parameters.end(),
                        [&](const SweptParameter& other) { return other.name == one->name; });
        if (twice) {
            return fail(ErrorCode::Usage, "Give all values of a parameter in one --param.",
                        one->name);
        }
        if (one->values.size() > kMostCombinations / combined) {
            return fail(ErrorCode::Usage,
                        fmt::format("That is more than {} combinations.", kMostCombinations), text);
        }
        combined *= one->values.size();
        parameters.push_back(std::move(*one));
    }
    return parameters;
}

/// Indices of the named metrics in plannerMetricInfos().
Result<std::vector<int>> findMetrics(const std::vector<std::string>& names) {
    const auto& metrics = planning::plannerMetricInfos();
    std::vector<std::string> known;
    for (const planning::MetricInfo& metric : metrics) known.emplace_back(metric.name);
    std::vector<int> found;
    for (const std::string& name : names) {
        const auto at = std::find(known.begin(), known.end(), name);
        if (at == known.end()) {
            const std::string closest = closestName(name, known);
            return fail(ErrorCode::Usage,
                        closest.empty() ? fmt::format("The metric is unknown; the metrics are {}.",
                                                      fmt::join(known, ", "))
                                        : "The metric is unknown; did you mean " + closest + "?",
                        name);
        }
        found.push_back(static_cast<int>(at - known.begin()));
    }
    return found;
}

/// All combinations; the first parameter changes slowest, so that what depends on it is computed
/// once.
std::vector<std::vector<std::string>> combinations(const std::vector<SweptParameter>& parameters) {
    std::vector<std::vector<std::string>> all = {{}};
    for (const SweptParameter& parameter : parameters) {
        std::vector<std::vector<std::string>> longer;
        for (const auto& one : all) {
            for (const std::string& value : parameter.values) {
                longer.push_back(one);
                longer.back().push_back(value);
            }
        }
        all = std::move(longer);
    }
    return all;
}

/// Default planners and metrics; the paper's figure 5 compares our planner with the paper's
/// smoothing.
void setDefaults(SweepArguments& arguments, const std::vector<SweptParameter>& parameters) {
    const bool figure_5 = parameters.front().name == "corner_distance_m";
    if (arguments.planners.empty()) {
        arguments.planners = {"dollytrack"};
        if (figure_5) arguments.planners.emplace_back("paper-smoothing");
    }
    if (arguments.metrics.empty()) {
        if (figure_5) arguments.metrics = {"corner_collision_rate", "move_collision_rate"};
        arguments.metrics.emplace_back("well_captured_rate");
    }
    for (const SweptParameter& parameter : parameters) {
        if (parameter.name == "seed") arguments.scene.seed.reset();
        if (parameter.name == "max_frames") arguments.scene.max_frames.reset();
    }
}

Result<ExitCode> runSweep(SweepArguments arguments, const Session& session) {
    const auto parameters = parseParameters(arguments.parameters);
    if (!parameters) return tl::unexpected(parameters.error());
    setDefaults(arguments, *parameters);
    const auto metrics = findMetrics(arguments.metrics);
    if (!metrics) return tl::unexpected(metrics.error());
    const auto planners = planning::choosePlanners(arguments.planners);
    if (!planners) return tl::unexpected(planners.error());
    if (!arguments.plot.empty()) {
        if (Status status = render::checkFigureName(arguments.plot); !status) {
            return tl::unexpected(std::move(status.error()));
        }
        if (Status status = checkAxis(parameters->front()); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    for (const std::string& path : {arguments.csv, arguments.plot}) {
        if (Status status = checkWritable(path); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    const JobContext job = session.job();
    Sweeper sweeper(arguments.scene);
    std::vector<SweepPoint> points;
    int failures = 0;
    const auto all = combinations(*parameters);
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::vector<std::string> assignments;
        std::string text;
        for (std::size_t p = 0; p < all[i].size(); ++p) {
            assignments.push_back((*parameters)[p].name + "=" + all[i][p]);
            text += (text.empty() ? "" : " ") + assignments.back();
        }
        const auto count = static_cast<double>(all.size());
        const JobContext part =
            job.stage(static_cast<double>(i) / count, static_cast<double>(i + 1) / count, text);
        part.report(0.0);
        auto made = sweeper.at(assignments, *planners, part);
        if (!made) return tl::unexpected(std::move(made.error()));
        for (SweepPoint& point : *made) {
            if (!point.gap.empty()) {
                log::warn("sweep", text + ", " + point.planner + ": " + point.gap);
                ++failures;
            }
            point.values = all[i];
            points.push_back(std::move(point));
        }
    }
    // Printed before writing files, so that a full disk does not lose the results.
    fmt::print("{}", sweepTable(*parameters, points, *metrics));
    if (!arguments.csv.empty()) {
        if (Status status = writeWhole(arguments.csv, sweepCsv(*parameters, points)); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    if (!arguments.plot.empty()) {
        const std::string title = std::filesystem::path(arguments.scene.path).filename().string();
        const render::Figure figure = sweepFigure(title, *parameters, points, *metrics);
        if (Status status = render::writeFigure(figure, arguments.plot); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    return failures == 0 ? kDone : kPartial;
}

}  // namespace

void addSweepCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "sweep", "Plan with every value of a parameter and show its effect on the metrics");
    auto arguments = std::make_shared<SweepArguments>();
    arguments->scene.max_frames = 300;
    addSceneArguments(*command, arguments->scene);
    addParameterArguments(*command, arguments->scene);
    command
        ->add_option("--param", arguments->parameters,
                     "Parameter and values: NAME=FROM:TO:STEP or NAME=A,B,C; repeatable, for a "
                     "second parameter")
        ->required()
        ->type_name("VALUES")
        ->allow_extra_args(false);
    command
        ->add_option("--metric", arguments->metrics,
                     "Metric to show; repeatable (the CSV has all metrics)")
        ->type_name("NAME")
        ->allow_extra_args(false);
    command
        ->add_option("--planners,--planner", arguments->planners,
                     "Planners, separated by commas (see 'dollytrack compare --list')")
        ->delimiter(',')
        ->type_name("NAMES");
    command->add_option("--csv", arguments->csv, "Write all metrics and stage times")
        ->type_name("FILE");
    command->add_option("--plot", arguments->plot, "Plot the metrics over the first parameter")
        ->type_name("FILE.svg|png");
    command->footer(
        "Example, the paper's figure 5 with its smoothing and Dollytrack's:\n"
        "  dollytrack sweep room.glb --param corner_distance_m=0.05:1:0.05 --plot figure5.svg");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runSweep(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
