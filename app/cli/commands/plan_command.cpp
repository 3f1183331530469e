#include "app/cli/command_line.h"
#include "app/cli/export/backend_option.h"
#include "app/cli/plan/baseline_plan.h"
#include "app/cli/plan/coverage_output.h"
#include "app/cli/plan/ledger_table.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/plan/planned_scene.h"
#include "app/cli/requirement.h"
#include "app/cli/scene_arguments.h"
#include "app/cli/scene_options.h"
#include "app/cli/terminal/output_file.h"
#include "app/cli/terminal/terminal_text.h"
#include "engine/core/log.h"
#include "engine/geometry/ray_caster.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/png_writer.h"
#include "engine/io/settings/project_file.h"
#include "engine/io/trajectories/trajectory_file.h"
#include "engine/jobs/job_phases.h"
#include "engine/plan/frame_quality.h"
#include "engine/plan/ledger_json.h"
#include "engine/plan/plan_json.h"
#include "planning/analysis/capture_bound.h"
#include "planning/analysis/frame_quality.h"
#include "planning/pipeline/search_environment.h"
#include "planning/remedies/remedies.h"
#include "render/draw/overview.h"
#include "render/draw/storey_cutaway.h"
#include "render/overlays/plan_overlay.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

namespace dollytrack::cli {
namespace {

struct PlanArguments {
    SceneArguments scene;
    std::string out;
    std::string picture;
    int storey = 0;         // storey shown in the image; 0: the topmost
    BackendOption backend;  // OpenGL backend for the image
    std::vector<std::string> coverage;
    std::string frames;  // table of the frames
    std::string poses;   // the trajectory as text
    std::vector<std::string> requirements;
    std::string planner = "dollytrack";
    bool as_json = false;
    bool bound = false;
    bool quality = false;
    bool explain = false;
};

bool asksForQuality(const PlanArguments& arguments) {
    return arguments.quality || !arguments.frames.empty();
}

/// Phases of the work, as the progress names them.
constexpr const char* kLoading = "loading";
constexpr const char* kPlanning = "planning";
constexpr const char* kDenseSearch = "dense search";
constexpr const char* kFrames = "frames";
constexpr const char* kRemedies = "remedies";
constexpr const char* kPicture = "picture";
constexpr const char* kCoverage = "coverage";

/// The parts that were asked for, by how long they usually take compared with each other.
JobPhases phasesOf(const PlanArguments& arguments, const JobContext& job) {
    return {job,
            {{kLoading, 1.0},
             {kPlanning, 4.0},
             {kDenseSearch, arguments.bound ? 2.0 : 0.0},
             {kFrames, asksForQuality(arguments) ? 4.0 : 0.0},
             {kRemedies, arguments.explain ? 40.0 : 0.0},
             {kPicture, arguments.picture.empty() ? 0.0 : 20.0},
             {kCoverage, arguments.coverage.empty() ? 0.0 : 40.0}}};
}

/// A context that keeps the phase's name while plans inside it report stages of their own.
JobContext hideInnerStages(const Session& session, JobContext part) {
    return {session.cancelled,
            [part = std::move(part)](double fraction, std::string_view) { part.report(fraction); }};
}

Status addDenseSearch(const OpenedScene& opened, const planning::Pipeline& pipeline,
                      const Plan& plan, nlohmann::json& metrics, const JobContext& job) {
    const auto begin = std::chrono::steady_clock::now();
    const planning::SearchEnvironment search(planning::mapsOf(pipeline, opened.scene),
                                             opened.params);
    const auto bound = planning::boundCaptures(search.environment(), plan, opened.params.seed, job);
    if (!bound) return tl::unexpected(bound.error());
    const std::chrono::duration<double, std::milli> spent =
        std::chrono::steady_clock::now() - begin;
    addBound(metrics, *bound, spent.count());
    return {};
}

/// Measures how well other programs can use the frames: adds that to the metrics, and writes the
/// table of the frames.
Status addQuality(const OpenedScene& opened, const planning::Pipeline& pipeline, const Plan& plan,
                  const PlanArguments& arguments, nlohmann::json& metrics, const JobContext& job) {
    const planning::SearchEnvironment search(planning::mapsOf(pipeline, opened.scene),
                                             opened.params);
    const auto quality =
        planning::measureFrameQuality(search.environment(), opened.params, plan, job);
    if (!quality) return tl::unexpected(quality.error());
    addFrameQuality(metrics, plan.trajectory, *quality);
    if (arguments.frames.empty()) return {};
    return writeWhole(arguments.frames, frameTable(plan.trajectory, plan.series, *quality));
}

/// Adds remedies to the ledger, also in the plan's metrics and in the result to be stored.
Result<std::vector<LedgerRow>> explain(const OpenedScene& opened, PlannedScene& planned,
                                       const JobContext& job) {
    auto rows = planning::findRemedies(opened.scene, opened.params, opened.plan_edits,
                                       *planned.plan, planned.plan->ledger, job);
    if (!rows) return rows;
    planned.metrics["ledger"] = ledgerJson(*opened.scene, *rows);
    planned.metrics["uncaptured"] = uncapturedJson(*opened.scene, *rows);
    planned.result["metrics"] = withoutTimes(planned.metrics);
    return rows;
}

Status savePicture(const OpenedScene& opened, const planning::Pipeline& pipeline, const Plan& plan,
                   const PlanArguments& arguments, const JobContext& job) {
    const std::size_t storeys = render::storeysOf(*opened.scene, plan.rooms).size();
    if (arguments.storey > static_cast<int>(storeys)) {
        return fail(
            ErrorCode::Usage,
            fmt::format("There is no storey {}; the building has {}.", arguments.storey, storeys),
            "--storey");
    }
    render::OverviewSettings settings;
    settings.storey = arguments.storey;
    Result<std::unique_ptr<gl::Context>> context = arguments.backend.createContext();
    if (!context) return tl::unexpected(std::move(context.error()));
    const auto picture = render::renderOverview(
        std::move(*context), *opened.scene, *pipeline.rays(),
        render::planOverlay(*opened.scene, plan, opened.params.camera), settings, plan.rooms, job);
    if (!picture) return tl::unexpected(picture.error());
    const auto png = encodePng(picture->width, picture->height, PngFormat::Rgb8, picture->rgb);
    if (!png) return tl::unexpected(png.error());
    return writeWhole(arguments.picture, *png);
}

Status saveCoverage(const OpenedScene& opened, planning::Pipeline& pipeline, const Plan& plan,
                    const std::vector<std::string>& paths, const JobContext& job) {
    const auto curves =
        planning::coverageCurves(pipeline, opened.params, opened.plan_edits, plan, job);
    if (!curves) return tl::unexpected(curves.error());
    const std::string title =
        fmt::format("{}: coverage by budget", opened.scene->source.filename().string());
    for (const std::string& path : paths) {
        if (Status status = writeCoverage(title, *curves, path); !status) return status;
    }
    return {};
}

/// Checked before the work: a misspelt metric must not cost minutes.
Status knowsMetrics(const std::vector<Requirement>& requirements, const PlanArguments& arguments) {
    nlohmann::json metrics = metricsOf("dollytrack");
    if (arguments.bound) addBound(metrics, {}, 0.0);
    if (asksForQuality(arguments)) addFrameQuality(metrics, {}, {});
    return checkNames(requirements, metrics);
}

/// Refuses options that only plans of our own planner support.
Status checkBaselineUsage(const PlanArguments& arguments) {
    const std::vector<std::pair<bool, const char*>> ours = {
        {!arguments.out.empty(), "--out"},
        {!arguments.picture.empty(), "--picture"},
        {!arguments.coverage.empty(), "--coverage"},
        {arguments.bound, "--bound"},
        {arguments.quality, "--quality"},
        {!arguments.frames.empty(), "--frames"},
        {arguments.explain, "--explain"},
    };
    for (const auto& [given, option] : ours) {
        if (!given) continue;
        return fail(ErrorCode::Usage,
                    "This needs Dollytrack's own planner; leave out --planner, or use 'export "
                    "--planner' for a dataset of the other planner's trajectory.",
                    option);
    }
    return {};
}

Status writePoses(const Trajectory& trajectory, const std::string& file) {
    return file.empty() ? Status{} : writeWhole(file, tumText(trajectory));
}

/// Prints the metrics of a baseline planner's trajectory.
Result<ExitCode> runBaseline(const PlanArguments& arguments,
                             const std::vector<Requirement>& requirements, const Session& session) {
    if (Status status = checkBaselineUsage(arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (Status status = checkNames(requirements, metricsOf(arguments.planner)); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (Status status = checkWritable(arguments.poses); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const JobContext job = session.job();
    const Result<OpenedScene> opened = openScene(arguments.scene, job.stage(0.0, 0.3, "loading"));
    if (!opened) return tl::unexpected(opened.error());
    const auto planned =
        planWithBaseline(arguments.planner, *opened, job.stage(0.3, 1.0, "planning"));
    if (!planned) return tl::unexpected(planned.error());
    if (Status status = writePoses(planned->trajectory, arguments.poses); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(planned->metrics));
    } else {
        fmt::print("{}", plannerMetricsTable(planned->metrics));
    }
    return areMet(requirements, planned->metrics) ? kDone : kPartial;
}

/// Writes the project, the poses, the picture and the coverage that were asked for.
Status writeFiles(const OpenedScene& opened, planning::Pipeline& pipeline,
                  const PlannedScene& planned, const PlanArguments& arguments,
                  const Session& session, const JobPhases& phases) {
    if (!arguments.out.empty()) {
        ProjectFile project = projectOf(opened);
        project.result = planned.result;
        if (Status status = saveProject(project, arguments.out); !status) return status;
    }
    if (Status status = writePoses(planned.trajectory, arguments.poses); !status) return status;
    if (!arguments.picture.empty()) {
        if (Status status = savePicture(opened, pipeline, *planned.plan, arguments,
                                        hideInnerStages(session, phases.of(kPicture)));
            !status) {
            return status;
        }
    }
    if (arguments.coverage.empty()) return {};
    return saveCoverage(opened, pipeline, *planned.plan, arguments.coverage,
                        hideInnerStages(session, phases.of(kCoverage)));
}

/// Checked before the work: files with another extension cannot be opened again.
Status checkFiles(const PlanArguments& arguments) {
    if (!arguments.out.empty() && std::filesystem::path(arguments.out).extension() != ".dolly") {
        return fail(ErrorCode::Usage, "A project's name must end in .dolly.", arguments.out);
    }
    if (!arguments.picture.empty() &&
        std::filesystem::path(arguments.picture).extension() != ".png") {
        return fail(ErrorCode::Usage, "The image's name must end in .png.", arguments.picture);
    }
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (!arguments.frames.empty() && std::ranges::all_of(arguments.frames, is_digit)) {
        return fail(ErrorCode::Usage,
                    "This is the name of a table; --max-frames limits the number of frames.",
                    "--frames " + arguments.frames);
    }
    for (const std::string& file :
         {arguments.out, arguments.picture, arguments.frames, arguments.poses}) {
        if (Status status = checkWritable(file); !status) return status;
    }
    return checkCoverageFiles(arguments.coverage);
}

/// Adds the measurements of the plan that were asked for to its metrics.
Status addMeasurements(const OpenedScene& opened, const planning::Pipeline& pipeline,
                       PlannedScene& planned, const PlanArguments& arguments,
                       const JobPhases& phases) {
    if (!arguments.bound && !asksForQuality(arguments)) return {};
    if (arguments.bound) {
        if (Status status = addDenseSearch(opened, pipeline, *planned.plan, planned.metrics,
                                           phases.of(kDenseSearch));
            !status) {
            return status;
        }
    }
    if (asksForQuality(arguments)) {
        if (Status status = addQuality(opened, pipeline, *planned.plan, arguments, planned.metrics,
                                       phases.of(kFrames));
            !status) {
            return status;
        }
    }
    planned.result["metrics"] = withoutTimes(planned.metrics);
    return {};
}

Result<ExitCode> runPlan(const PlanArguments& arguments, const Session& session) {
    const auto requirements = parseRequirements(arguments.requirements);
    if (!requirements) return tl::unexpected(requirements.error());
    const Result<bool> baseline = namesBaseline(arguments.planner);
    if (!baseline) return tl::unexpected(baseline.error());
    if (*baseline) return runBaseline(arguments, *requirements, session);
    if (Status status = checkFiles(arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (Status status = knowsMetrics(*requirements, arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const JobPhases phases = phasesOf(arguments, session.job());
    const Result<OpenedScene> opened = openScene(arguments.scene, phases.of(kLoading));
    if (!opened) return tl::unexpected(opened.error());
    planning::Pipeline pipeline(opened->scene);
    Result<PlannedScene> planned = planScene(*opened, pipeline, phases.of(kPlanning));
    if (!planned) return tl::unexpected(std::move(planned.error()));
    if (Status status = addMeasurements(*opened, pipeline, *planned, arguments, phases); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    std::vector<LedgerRow> ledger;
    if (arguments.explain) {
        auto rows = explain(*opened, *planned, hideInnerStages(session, phases.of(kRemedies)));
        if (!rows) return tl::unexpected(std::move(rows.error()));
        ledger = std::move(*rows);
    }
    if (Status status = writeFiles(*opened, pipeline, *planned, arguments, session, phases);
        !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(planned->metrics));
    } else {
        // The ledger table contains the same reasons and more.
        if (arguments.explain) planned->metrics.erase("uncaptured");
        fmt::print("{}", metricsTable(planned->metrics));
    }
    if (arguments.explain && !arguments.as_json) {
        fmt::print("\n{}", ledgerTable(*opened->scene, ledger, terminalWidth()));
    }
    return areMet(*requirements, planned->metrics) ? kDone : kPartial;
}

}  // namespace

void addPlanCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "plan", "Plan a camera trajectory and report how well it captures the objects");
    auto arguments = std::make_shared<PlanArguments>();
    addSceneArguments(*command, arguments->scene);
    addParameterArguments(*command, arguments->scene);
    addPlannerArgument(*command, arguments->planner);
    command->add_option("-o,--out", arguments->out, "Project to write, with the plan")
        ->type_name("FILE.dolly");
    command
        ->add_option("--time", arguments->scene.time_s,
                     "Plan with objects at their tracks' poses at this time, s; a written project "
                     "keeps them there")
        ->type_name("S");
    command
        ->add_option("--picture", arguments->picture,
                     "Image of the planned room to write, seen from above")
        ->type_name("FILE.png");
    command
        ->add_option("--storey", arguments->storey,
                     "Storey shown in the image, 1 is the lowest; default: the topmost")
        ->type_name("N")
        ->check(CLI::Range(1, 1000))
        ->needs("--picture");
    addBackendOption(*command, arguments->backend);
    command
        ->add_option("--coverage", arguments->coverage,
                     "Also plan with increasing budgets of frames and length and write the "
                     "coverage, as a table or image by the file's extension; repeatable")
        ->type_name("FILE.csv|svg|png")
        ->allow_extra_args(false);
    command
        ->add_option("--frames", arguments->frames,
                     "Table of measurements of each frame to write, such as clearance, image "
                     "corners and overlap with the frame before; includes --quality")
        ->type_name("FILE.csv");
    command
        ->add_option(
            "--poses", arguments->poses,
            "Trajectory to write as text (TUM): seconds, x y z, qx qy qz qw of each frame; "
            "world in m with z up, camera with x right, y down, z forward")
        ->type_name("FILE.txt");
    command->add_flag("--json", arguments->as_json, "Print the metrics as JSON");
    command->add_flag("--bound", arguments->bound,
                      "Also compute an upper bound by a dense viewpoint search (slow)");
    command->add_flag("--quality", arguments->quality,
                      "Also measure surface that no frame shows, frames with few image corners, "
                      "and gaps between consecutive frames");
    command->add_flag("--explain", arguments->explain,
                      "List for every object the frame that captures it and how well, or the "
                      "reason why none does and a remedy");
    command
        ->add_option(
            "--require", arguments->requirements,
            "Exit with code 3 unless a metric meets a condition, as in 'well_captured_rate>=0.8'")
        ->type_name("CONDITION")
        ->allow_extra_args(false);
    command->footer(
        "Example: dollytrack plan room.glb -o room.dolly --set fill=0.5 --max-frames 300");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runPlan(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
