#include "app/cli/command_line.h"
#include "app/cli/compare/evaluation.h"
#include "app/cli/export/dataset_scene.h"
#include "app/cli/plan/metrics_table.h"
#include "engine/io/pointcloud/files/ply_points.h"
#include "render/verify/compare/observed_surface.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace dollytrack::cli {
namespace {

constexpr double kNear_m = 0.05;      // distance limit for completeness
constexpr double kSpacing_m = 0.025;  // spacing of the reference surface points: half of that

struct EvaluateArguments {
    std::string folder;
    std::vector<std::string> estimated;
    std::vector<std::string> clouds;
    std::string align = "se3";
    TrajectoryErrorSettings settings;
    SuccessLimits limits;
    DatasetSceneArguments scene;
    bool as_json = false;
};

Status addReconstruction(const EvaluateArguments& arguments, const verify::StoredDataset& dataset,
                         std::vector<RunFigures>& runs, const JobContext& job) {
    Result<DatasetScene> scene =
        openDatasetScene(dataset, arguments.scene, job.stage(0.0, 0.3, "loading"));
    if (!scene) return tl::unexpected(std::move(scene.error()));
    if (!scene->rays) {
        return fail(ErrorCode::BadInput, "For --cloud " + scene->missing + ".", arguments.folder);
    }
    const std::vector<Eigen::Vector3d> surface = verify::observedSurface(dataset, kSpacing_m);
    for (std::size_t i = 0; i < arguments.clouds.size(); ++i) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "The evaluation was stopped.");
        Result<std::vector<Eigen::Vector3d>> cloud = readPlyPoints(arguments.clouds[i]);
        if (!cloud) return tl::unexpected(std::move(cloud.error()));
        RunFigures& run = runs[i];
        // A point cloud is aligned by its run's trajectory.
        if (!run.error.measured) continue;
        for (Eigen::Vector3d& point : *cloud) point = run.error.world_from_estimate * point;
        run.cloud = arguments.clouds[i];
        run.reconstruction = cloudError(*cloud, *scene->rays);
        if (!surface.empty()) run.completeness = coveredShare(surface, *cloud, kNear_m);
        job.reportItems(static_cast<int>(i) + 1, static_cast<int>(arguments.clouds.size()));
    }
    return {};
}

Result<ExitCode> runEvaluate(EvaluateArguments arguments, const Session& session) {
    arguments.settings.alignment = arguments.align == "none"   ? Alignment::None
                                   : arguments.align == "sim3" ? Alignment::Similarity
                                                               : Alignment::Rigid;
    if (arguments.clouds.size() > arguments.estimated.size()) {
        return fail(ErrorCode::Usage,
                    "There are more point clouds than runs; give an --estimated for each --cloud.",
                    "--cloud");
    }
    const JobContext job = session.job();
    const auto dataset = verify::readStoredDataset(arguments.folder);
    if (!dataset) return tl::unexpected(dataset.error());
    const Trajectory truth = trueTrajectory(*dataset);
    std::vector<RunFigures> runs;
    for (const std::string& path : arguments.estimated) {
        const Result<Trajectory> estimate = readEstimate(path);
        if (!estimate) return tl::unexpected(estimate.error());
        RunFigures run;
        run.name = path;
        run.error = trajectoryError(truth, *estimate, arguments.settings);
        run.not_measured = whyNotMeasured(truth, *estimate, run.error, arguments.settings);
        run.success = isSuccess(run.error, arguments.limits);
        runs.push_back(std::move(run));
    }
    if (!arguments.clouds.empty()) {
        if (Status status = addReconstruction(arguments, *dataset, runs, job); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(evaluationJson(runs, arguments.limits)));
    } else {
        fmt::print("{}: {} frames\n\n{}", arguments.folder, truth.frames.size(),
                   evaluationText(runs, arguments.limits, arguments.settings));
    }
    return kDone;
}

}  // namespace

void addEvaluateCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "evaluate", "Measure the trajectory that a SLAM program estimated from a dataset");
    auto arguments = std::make_shared<EvaluateArguments>();
    command->add_option("dataset", arguments->folder, "Folder of the dataset")
        ->required()
        ->type_name("DIR");
    command
        ->add_option("--estimated", arguments->estimated,
                     "Estimated trajectory of a run, with times (TUM); repeatable, one per run")
        ->required()
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        ->add_option("--cloud", arguments->clouds,
                     "Reconstructed points of a run (PLY), in the order of --estimated; repeatable")
        ->type_name("PLY")
        ->allow_extra_args(false);
    command
        ->add_option("--align", arguments->align,
                     "Alignment of the estimate with the truth: se3 (rotation and translation), "
                     "sim3 (also scale) or none")
        ->check(CLI::IsMember({"se3", "sim3", "none"}))
        ->type_name("se3|sim3|none")
        ->capture_default_str();
    command
        ->add_option("--max-dt", arguments->settings.max_dt_s,
                     "Largest difference between the times of a pose and its frame, s")
        ->check(CLI::Range(0.0, 1e6).description("0 .. 1e6"))
        ->type_name("SECONDS")
        ->capture_default_str();
    command
        ->add_option("--delta", arguments->settings.delta,
                     "Number of frames over which relative errors are measured")
        ->check(CLI::Range(1, 1'000'000).description("1 .. 1000000"))
        ->type_name("FRAMES")
        ->capture_default_str();
    command
        ->add_option("--min-tracked", arguments->limits.min_tracked,
                     "A run fails if it has poses for less than this share of the frames")
        ->check(CLI::Range(0.0, 1.0).description("0 .. 1"))
        ->type_name("SHARE")
        ->capture_default_str();
    command
        ->add_option("--max-ate", arguments->limits.max_ate_m,
                     "A run fails if its absolute error (RMSE, m) is larger")
        ->check(CLI::Range(0.0, 1e6).description("0 .. 1e6"))
        ->type_name("METRES")
        ->capture_default_str();
    addDatasetSceneArguments(*command, arguments->scene);
    command->add_flag("--json", arguments->as_json, "Print the figures as JSON");
    command->footer(
        "Absolute errors are the distances of the estimated to the true camera positions, relative "
        "ones\nthose of the motions over --delta frames. A point cloud is aligned with its run's "
        "trajectory.\nAn estimate without any pose is a run that has failed, not an error: the "
        "exit code is 0 even\nwhen all runs have failed; see success_rate in --json.\nExample: "
        "dollytrack evaluate dataset --estimated CameraTrajectory.txt --cloud map.ply");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runEvaluate(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
