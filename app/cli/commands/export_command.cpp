#include "app/cli/command_line.h"
#include "app/cli/export/backend_option.h"
#include "app/cli/export/dataset_export.h"
#include "app/cli/export/export_metrics.h"
#include "app/cli/export/export_warnings.h"
#include "app/cli/plan/baseline_plan.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/plan/planned_scene.h"
#include "app/cli/requirement.h"
#include "app/cli/scene_arguments.h"
#include "app/cli/scene_options.h"
#include "render/dataset/export_preset.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <span>

namespace dollytrack::cli {
namespace {

struct ExportArguments {
    SceneArguments scene;
    std::string out;
    std::string within;
    std::string range = "::";
    std::string preset;
    std::vector<std::string> modalities;
    std::vector<std::string> formats;
    std::string planner = "dollytrack";
    render::FoldSettings folds;
    std::string rig;                   // file with rig cameras
    std::vector<std::string> cameras;  // additional rig cameras, NAME:field=value,...
    bool overwrite = false;
    bool resume = false;
    bool still = false;
    std::vector<int> flow_distances = {1};
    BackendOption backend;
    std::vector<std::string> requirements;
    bool as_json = false;
};

/// Prints the scanned share of a scan's rooms; nothing for a modelled scene.
void printScanned(const nlohmann::json& planned) {
    const std::string scanned = scannedText(planned);
    if (!scanned.empty()) fmt::print("\nscan: {}\n", scanned);
}

void printSummary(const render::DatasetSummary& summary, const std::string& folder,
                  const nlohmann::json& planned) {
    const CaptureMetrics& counted = summary.counted;
    fmt::print("{} frames in {}\n\n", summary.frames, folder);
    fmt::print("  {:<22} {:>10} {:>10}\n", "", "planned", "counted");
    const auto row = [&](std::string_view what, const char* name, int value) {
        fmt::print("  {:<22} {:>10} {:>10}\n", what, planned.value(name, 0), value);
    };
    const auto rate = [&](std::string_view what, const char* name, double value) {
        const auto found = planned.find(name);
        const bool known = found != planned.end() && found->is_number();
        fmt::print("  {:<22} {:>10} {:>8.1f} %\n", what,
                   known ? fmt::format("{:.1f} %", 100.0 * found->get<double>()) : "-",
                   100.0 * value);
    };
    row("objects", "objects", counted.objects);
    row("captured", "captured", counted.captured);
    row("well captured", "well_captured", counted.well_captured);
    rate("capture rate", "capture_rate", counted.capture_rate);
    rate("well captured rate", "well_captured_rate", counted.well_captured_rate);
    rate("area share (box)", "area_share_box", counted.area_share_box);
    if (const render::PictureTally& pictures = summary.pictures; pictures.pictures > 0) {
        fmt::print("  {:<22} {:>10} {:>10}\n", "unusable images", "-", pictures.unusable());
        const std::string text = render::unusableText(pictures);
        if (!text.empty()) fmt::print("\n{}\n", text);
    }
    if (summary.frames < planned.value("frames", 0)) {
        fmt::print("\nplanned: for all {} frames of the trajectory; counted: in the {} exported\n",
                   planned.value("frames", 0), summary.frames);
    }
    printScanned(planned);
    if (!summary.contact_sheet.empty()) {
        fmt::print("\ncontact sheet: {}\n", summary.contact_sheet.string());
    }
}

/// Prints one line per room; rates over all targets are meaningless for one room.
void printRoom(const std::string& room, const render::DatasetSummary& summary,
               const std::string& folder) {
    fmt::print("{:<14} {:>6} frames, {} objects captured, {} well; in {}\n", room, summary.frames,
               summary.counted.captured, summary.counted.well_captured, folder);
}

/// Prints the rows of a table by group.
template <class Row>
void printTable(const char* title, std::span<const Row> rows) {
    fmt::print("{}\n", title);
    for (const std::string_view group : render::kContentGroupNames) {
        bool first = true;
        for (const Row& row : rows) {
            if (render::groupName(row.group) != group) continue;
            if (first) fmt::print("  {}\n", group);
            first = false;
            fmt::print("    {:<21} {} {}\n", row.name, row.standard ? '*' : ' ', row.text);
        }
    }
}

/// Prints the names accepted by --preset, --modalities and --formats.
void printChoices() {
    fmt::print("presets\n");
    for (const render::ExportPreset& preset : render::exportPresets()) {
        fmt::print("  {:<14} {}\n", preset.name, preset.text);
    }
    printTable("modalities", render::modalities());
    printTable("formats", render::formats());
    fmt::print("*: written by default; 'all' selects all.\n");
    fmt::print(
        "Every dataset has dataset.json, which describes it, and a contact sheet if it has "
        "images.\n");
}

template <class Row>
std::string names(std::span<const Row> rows) {
    std::string all;
    for (const Row& row : rows) all += (all.empty() ? "" : ",") + std::string(row.name);
    return all;
}

template <class Row>
std::string standardNames(std::span<const Row> rows) {
    std::string all;
    for (const Row& row : rows) {
        if (row.standard) all += (all.empty() ? "" : ",") + std::string(row.name);
    }
    return all;
}

/// The fields accepted by --camera.
std::string cameraFields() {
    RigCamera standard;
    std::string all;
    for (const Field& field : listRigCameraFields(standard)) {
        all += fmt::format("{}{} ({})", all.empty() ? "" : "; ", field.name, field.rangeText());
    }
    return all;
}

void addPresetOption(CLI::App& command, std::string& preset) {
    std::string known;
    for (const render::ExportPreset& one : render::exportPresets()) {
        known += (known.empty() ? "" : ",") + std::string(one.name);
    }
    command
        .add_option("--preset", preset,
                    "Modalities and formats for one use of a dataset (see --list); --modalities "
                    "and --formats replace its lists. The motion is set with --set motion_preset")
        ->type_name("NAME:{" + known + "}");
}

Result<ExportOrder> orderOf(const ExportArguments& arguments) {
    ExportOrder order;
    render::DatasetSettings& settings = order.settings;
    const Result<render::FrameRange> range = render::parseFrameRange(arguments.range);
    if (!range) return tl::unexpected(range.error());
    settings.folder = arguments.out;
    settings.root = arguments.within;
    settings.range = *range;
    settings.modalities = arguments.modalities;
    settings.formats = arguments.formats;
    if (Status status = render::applyPreset(arguments.preset, settings); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    settings.flow_distances = arguments.flow_distances;
    settings.folds = arguments.folds;
    Result<Rig> rig = rigOf(arguments.rig, arguments.cameras);
    if (!rig) return tl::unexpected(std::move(rig.error()));
    settings.rig = std::move(*rig);
    if (Status status = checkSensor(arguments.scene.assignments, settings); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    settings.overwrite = arguments.overwrite;
    settings.resume = arguments.resume;
    order.still = arguments.still;
    order.scene = arguments.scene.path;
    order.backend = arguments.backend;
    return order;
}

void printExport(const ExportArguments& arguments, const std::vector<ExportedDataset>& datasets,
                 const nlohmann::json& planned_metrics, const nlohmann::json& printed) {
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(printed));
    } else if (datasets.front().room.empty()) {
        printSummary(datasets.front().summary, arguments.out, planned_metrics);
    } else {
        printScanned(planned_metrics);
    }
}

Result<ExitCode> runExport(const ExportArguments& arguments, const Session& session) {
    Result<ExportOrder> read = orderOf(arguments);
    if (!read) return tl::unexpected(std::move(read.error()));
    ExportOrder& order = *read;
    const render::DatasetSettings& settings = order.settings;
    const Result<bool> baseline = namesBaseline(arguments.planner);
    if (!baseline) return tl::unexpected(baseline.error());
    const auto requirements = parseRequirements(arguments.requirements);
    if (!requirements) return tl::unexpected(requirements.error());
    if (Status status = checkNames(*requirements, exportMetricsOf(arguments.planner)); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    // Spelling errors are reported before problems of the folder, since they must be fixed in any
    // case.
    if (Status status = render::checkChoices(settings); !status)
        return tl::unexpected(std::move(status.error()));
    if (Status status = checkArguments(arguments.scene); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    // Checked before the work.
    if (Status status = checkFolder(settings); !status) {
        return tl::unexpected(std::move(status.error()));
    }

    const JobContext job = session.job();
    Result<OpenedScene> opened = openScene(arguments.scene, job.stage(0.0, 0.03, "loading"));
    if (!opened) return tl::unexpected(opened.error());
    if (Status status = fitSensor(*opened, order.settings); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    warnOfExport(opened->params, order.settings);
    // Created early, so that a machine without OpenGL fails before minutes of planning.
    Result<std::unique_ptr<gl::Context>> context = order.backend.createContext();
    if (!context) return tl::unexpected(std::move(context.error()));
    const JobContext planning = job.stage(0.03, 0.06, "planning");
    const Result<PlannedScene> planned =
        *baseline ? planWithBaseline(arguments.planner, *opened, planning)
                  : planOrReuse(*opened, planning);
    if (!planned) return tl::unexpected(planned.error());
    const auto printIfRoom = [&](const ExportedDataset& one) {
        if (one.room.empty() || arguments.as_json) return;
        printRoom(one.room, one.summary, one.folder);
    };
    const auto datasets = exportPlanned(*opened, *planned, order, std::move(*context), printIfRoom,
                                        session.cancelled, job.stage(0.06, 1.0, ""));
    if (!datasets) return tl::unexpected(datasets.error());
    const nlohmann::json printed = exportJson(order, *datasets, planned->metrics);
    printExport(arguments, *datasets, planned->metrics, printed);
    return areMet(*requirements, exportMetrics(printed)) ? kDone : kPartial;
}

/// Options of the folder, and of the files that are written.
void addContentOptions(CLI::App& command, ExportArguments& arguments) {
    command.add_option("--out", arguments.out, "Folder for the dataset; created if missing")
        ->required()
        ->check([](const std::string& folder) {
            return folder.empty() ? "The name of the folder is empty." : "";
        })
        ->type_name("DIR");
    command
        .add_option("--range", arguments.range,
                    "Frames a to b (b not included), every s-th: 100:200, ::5")
        ->type_name("a:b:s");
    addPresetOption(command, arguments.preset);
    command
        .add_option("--modalities", arguments.modalities,
                    "Images to write: " + names(render::modalities()) +
                        "; or all (default: " + standardNames(render::modalities()) + ")")
        ->type_name("NAME,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command
        .add_option("--formats", arguments.formats,
                    "Annotations to write: " + names(render::formats()) +
                        "; or all (default: " + standardNames(render::formats()) + ")")
        ->type_name("NAME,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command.add_flag_callback(
        "--list",
        [] {
            printChoices();
            throw CLI::Success();
        },
        "List the presets, modalities and formats, then exit");
}

/// Options of flow, cameras, motion and folds.
void addDetailOptions(CLI::App& command, ExportArguments& arguments) {
    command
        .add_option("--flow-distances", arguments.flow_distances,
                    "Distances of optical flow, in frames later and earlier (default: 1)")
        ->type_name("N,...")
        ->allow_extra_args(false)
        ->delimiter(',');
    command
        .add_option("--rig", arguments.rig,
                    "Additional cameras mounted on the planned one, a JSON file (see the guide "
                    "Cameras); their images go to cameras/")
        ->type_name("FILE");
    command
        .add_option(
            "--camera", arguments.cameras,
            "One additional camera, as in left:lens=fisheye,yaw_deg=-90; repeatable; fields: " +
                cameraFields())
        ->type_name("NAME:FIELD=VALUE,...")
        ->allow_extra_args(false);
    command.add_flag("--still", arguments.still,
                     "Objects with a track stay at their planned poses");
    command
        .add_option("--folds", arguments.folds.count,
                    "Cross-validation lists with N folds, in folds/")
        ->type_name("N")
        ->check(CLI::Range(2, 100));
    command.add_option("--fold-seed", arguments.folds.seed, "Random seed of the folds")
        ->type_name("N")
        ->capture_default_str();
}

/// Options of the run: resuming, overwriting, OpenGL, requirements.
void addRunOptions(CLI::App& command, ExportArguments& arguments) {
    command.add_flag("--resume", arguments.resume,
                     "Resume an interrupted export with the same arguments");
    command.add_flag("--overwrite", arguments.overwrite,
                     "Replace a complete dataset once the new one is complete; also allows a "
                     "folder with other files, which are kept");
    command
        .add_option("--within", arguments.within,
                    "Folder that contains --out; symbolic links below it are not followed")
        ->type_name("DIR");
    addBackendOption(command, arguments.backend);
    command
        .add_option("--require", arguments.requirements,
                    "Exit with code 3 unless a metric meets a condition, as in 'dark_rate<=0.02'; "
                    "repeatable")
        ->type_name("CONDITION")
        ->allow_extra_args(false);
    command.add_flag("--json", arguments.as_json, "Print the summary as JSON");
}

}  // namespace

void addExportCommand(CLI::App& app, Session& session) {
    CLI::App* command =
        app.add_subcommand("export", "Render the planned trajectory as a labelled dataset");
    auto arguments = std::make_shared<ExportArguments>();
    addSceneArguments(*command, arguments->scene);
    addParameterArguments(*command, arguments->scene);
    addPlannerArgument(*command, arguments->planner);
    addContentOptions(*command, *arguments);
    addDetailOptions(*command, *arguments);
    addRunOptions(*command, *arguments);
    command->footer(
        "Rendering, light and sensors are set with --set: see picture, light and sensor in\n"
        "'dollytrack params'.\n"
        "A scene is planned first. A project's plan is used as it is, unless its scene file or a\n"
        "parameter of the plan has changed: then it is planned again, with a warning.\n"
        "A stopped export keeps its finished frames; the same command with --resume continues\n"
        "and ends with the same files. Without --resume, an unfinished dataset is started anew;\n"
        "a complete one is replaced only with --overwrite.\n"
        "The texts of LICENSE, COPYING and similar files beside the scene become LICENSES.\n"
        "With rooms=each, every room becomes a dataset in its own folder, like DIR/room_1.\n"
        "Example: dollytrack export room.dolly --out dataset --range ::5");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runExport(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
