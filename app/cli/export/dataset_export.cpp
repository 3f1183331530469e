#include "app/cli/export/dataset_export.h"

#include "app/cli/export/object_motions.h"
#include "app/cli/export/object_relations.h"
#include "app/cli/export/room_exports.h"
#include "app/cli/export/scene_licenses.h"
#include "app/cli/plan/metrics_table.h"
#include "engine/document/edits_json.h"
#include "engine/io/settings/annotation_file.h"
#include "engine/io/settings/import_settings.h"
#include "engine/io/settings/rig_file.h"
#include "engine/plan/plan_json.h"
#include "render/encoders/modalities.h"
#include "render/sensors/sensor_lens.h"

#include <filesystem>
#include <utility>

namespace dollytrack::cli {
namespace {

nlohmann::json summaryJson(const render::DatasetSummary& summary, const std::string& folder,
                           const nlohmann::json& planned) {
    return {{"out", folder},
            {"frames", summary.frames},
            {"contact_sheet", summary.contact_sheet.empty()
                                  ? nlohmann::json()
                                  : nlohmann::json(summary.contact_sheet.string())},
            {"planned", planned},
            {"counted", captureMetricsJson(summary.counted)},
            {"pictures", render::pictureTallyJson(summary.pictures)}};
}

/// Summary of one dataset per room, with rates over all images; the frame lists stay with the
/// rooms.
nlohmann::json roomsJson(const std::string& folder, nlohmann::json rooms,
                         const render::PictureTally& pictures) {
    nlohmann::json rates = render::pictureTallyJson(pictures);
    for (const char* list : {"dark", "white", "flat"}) rates.erase(list);
    return {{"out", folder}, {"rooms", std::move(rooms)}, {"pictures", std::move(rates)}};
}

void addTally(render::PictureTally& all, const render::PictureTally& one) {
    all.pictures += one.pictures;
    all.dark.insert(all.dark.end(), one.dark.begin(), one.dark.end());
    all.white.insert(all.white.end(), one.white.begin(), one.white.end());
    all.flat.insert(all.flat.end(), one.flat.begin(), one.flat.end());
}

/// The annotations file that the project names, or that lies beside the scene.
Result<Annotations> annotationsOf(const OpenedScene& opened) {
    std::optional<std::filesystem::path> given;
    if (opened.import.contains("annotations")) {
        given = opened.import["annotations"].get<std::string>();
    }
    return findAnnotations(opened.imported->source, given);
}

bool wants(const render::DatasetSettings& settings, std::string_view modality) {
    const auto chosen =
        render::chooseModalities(settings.modalities, {!settings.rig.empty(), true});
    return chosen && render::contains(*chosen, modality);
}

bool wantsSensor(const render::DatasetSettings& settings) {
    return wants(settings, render::kRgbSensor) || wants(settings, "depth_sensor");
}

/// Copies the settings that come from the plan's parameters.
void addParameters(const PlannedScene& planned, render::DatasetSettings& settings) {
    settings.imu_rate_hz = planned.params.imu.imu_rate_hz;
    settings.stereo_baseline_m = planned.params.stereo.stereo_baseline_m;
    settings.picture = planned.params.picture;
    settings.sensor = planned.params.sensor;
    settings.light = planned.params.light;
    settings.score = planned.params.repair.score;
}

/// The origin of the frames, as recorded in dataset.json.
Result<render::DatasetOrigin> originOf(const Trajectory& trajectory, const RayCaster& rays,
                                       const render::DatasetSettings& settings, bool still,
                                       const OpenedScene& opened, const PlannedScene& planned) {
    render::DatasetOrigin origin;
    origin.product_version = DOLLYTRACK_VERSION;
    origin.seed = static_cast<std::uint64_t>(planned.params.seed);
    planning::PlanParams params = planned.params;
    origin.edits_json = jsonText(editsJson(opened.edits));
    nlohmann::json parameters = toJson(planning::listFields(params));
    if (!wantsSensor(settings)) parameters.erase("sensor");
    origin.parameters_json = parameters.dump();
    origin.planned_metrics_json = jsonText(withoutTimes(planned.metrics));
    origin.rooms = planned.rooms;
    if (!still) {
        origin.motions = objectMotions(*planned.scene, opened.edits.scene, trajectory);
    }
    origin.relations = relationsOf(*planned.scene, rays, planned.params.targets);
    const Result<Annotations> said = annotationsOf(opened);
    if (!said) return tl::unexpected(said.error());
    overrideRelations(*planned.scene, said->relations, origin.relations);
    return origin;
}

Result<render::DatasetSummary> renderTrajectory(
    const Trajectory& trajectory, std::unique_ptr<gl::Context> context, const RayCaster& rays,
    const ExportOrder& order, const std::string& folder, const OpenedScene& opened,
    const PlannedScene& planned, const JobContext& job) {
    render::DatasetSettings settings = order.settings;
    settings.folder = folder;
    Result<render::DatasetOrigin> origin =
        originOf(trajectory, rays, settings, order.still, opened, planned);
    if (!origin) return tl::unexpected(std::move(origin.error()));
    const Result<ImportOptions> import = importOptionsFromJson(opened.import);
    if (!import) return tl::unexpected(import.error());
    origin->licenses = licensesOf(opened.imported->source, import->model_folders, settings.folder);
    return render::exportDataset(std::move(context), *planned.scene, rays, trajectory,
                                 planned.params.camera, std::move(settings), std::move(*origin),
                                 job);
}

Status checkNotEmpty(const ExportOrder& order, const OpenedScene& opened,
                     const PlannedScene& planned) {
    const std::string why = whyEmpty(planned);
    if (why.empty()) return {};
    return fail(ErrorCode::Failed, "The trajectory is empty: " + why + ".",
                order.scene.empty() ? opened.imported->source.string() : order.scene);
}

/// Writes one dataset per room, each into its own folder.
Result<std::vector<ExportedDataset>> exportRooms(
    const std::vector<RoomExport>& rooms, const ExportOrder& order, const auto& render,
    const std::function<void(const ExportedDataset&)>& on_written,
    const std::shared_ptr<const std::atomic<bool>>& cancel_flag, int all, const JobContext& job) {
    const render::DatasetSettings& settings = order.settings;
    render::DatasetSettings checked = settings;
    for (const RoomExport& one : rooms) {
        checked.folder = settings.folder / one.room;
        if (!std::filesystem::exists(checked.folder)) continue;
        if (Status status = render::checkSettings(checked); !status) {
            return tl::unexpected(std::move(status.error()));
        }
    }
    if (Status status = claimForRooms(settings.folder, settings.root, rooms); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    std::vector<ExportedDataset> written;
    int before = 0;
    for (const RoomExport& one : rooms) {
        const std::string folder = (settings.folder / one.room).string();
        const int count = static_cast<int>(one.trajectory.frames.size());
        auto summary =
            render(one.trajectory, folder, countedOn(job, cancel_flag, before, count, all));
        if (!summary) return tl::unexpected(summary.error());
        before += count;
        on_written(written.emplace_back(ExportedDataset{one.room, folder, std::move(*summary)}));
    }
    return written;
}

}  // namespace

Status checkSensor(const std::vector<std::string>& assignments,
                   const render::DatasetSettings& settings) {
    if (wantsSensor(settings)) return {};
    SensorParams standard;
    for (const Field& field : listSensorFields(standard)) {
        for (const std::string& assignment : assignments) {
            if (!assignment.starts_with(field.name + "=")) continue;
            return fail(ErrorCode::Usage,
                        "Sensor parameters only affect rgb_sensor and depth_sensor; add one of "
                        "them to --modalities.",
                        "--set " + assignment);
        }
    }
    return {};
}

Result<Rig> rigOf(const std::string& file, const std::vector<std::string>& cameras) {
    Rig rig;
    if (!file.empty()) {
        Result<Rig> read = readRig(file);
        if (!read) return read;
        rig = std::move(*read);
    }
    for (const std::string& text : cameras) {
        Result<RigCamera> camera = parseRigCamera(text);
        if (!camera) return tl::unexpected(std::move(camera.error()));
        rig.push_back(std::move(*camera));
    }
    if (Status status = validate(rig); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    return rig;
}

Status checkFolder(const render::DatasetSettings& settings) {
    render::DatasetSettings checked = settings;
    // Datasets per room have folders of their own, which are checked when each begins.
    checked.overwrite = checked.overwrite || holdsRooms(settings.folder);
    return render::checkSettings(checked);
}

Status fitSensor(OpenedScene& opened, const render::DatasetSettings& settings) {
    SensorParams& sensor = opened.params.sensor;
    sensor = render::fitPresetLens(opened.params.camera, sensor);
    if (!wants(settings, render::kRgbSensor)) return {};
    return render::validateLens(opened.params.camera, sensor);
}

Result<std::vector<ExportedDataset>> exportPlanned(
    const OpenedScene& opened, const PlannedScene& planned, ExportOrder order,
    std::unique_ptr<gl::Context> context,
    const std::function<void(const ExportedDataset&)>& on_written,
    std::shared_ptr<const std::atomic<bool>> cancel_flag, const JobContext& job) {
    if (Status status = checkNotEmpty(order, opened, planned); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    render::DatasetSettings& settings = order.settings;
    addParameters(planned, settings);
    Result<std::vector<RoomExport>> rooms = roomExports(planned);
    if (!rooms) return tl::unexpected(rooms.error());
    if (Status status = checkRooms(*rooms, settings.range, settings.folds); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    for (RoomExport& one : *rooms) {  // the number of exported frames, not of planned ones
        const int count = static_cast<int>(one.trajectory.frames.size());
        one.about["frames"] = render::framesOf(settings.range, count).size();
    }
    const RayCaster rays(*planned.scene);
    const auto render = [&](const Trajectory& trajectory, const std::string& folder,
                            const JobContext& part) -> Result<render::DatasetSummary> {
        if (!context) {  // consumed by the previous dataset
            auto created = order.backend.createContext();
            if (!created) return tl::unexpected(std::move(created.error()));
            context = std::move(*created);
        }
        return renderTrajectory(trajectory, std::move(context), rays, order, folder, opened,
                                planned, part);
    };
    if (!rooms->empty()) {
        if (settings.root.empty()) settings.root = settings.folder;
        return exportRooms(*rooms, order, render, on_written, cancel_flag,
                           static_cast<int>(planned.trajectory.frames.size()), job);
    }
    const std::string folder = settings.folder.string();
    auto summary = render(planned.trajectory, folder, job);
    if (!summary) return tl::unexpected(summary.error());
    std::vector<ExportedDataset> written;
    on_written(written.emplace_back(ExportedDataset{"", folder, std::move(*summary)}));
    return written;
}

Result<render::FrameSeries> beginFrames(const OpenedScene& opened, const PlannedScene& planned,
                                        const RayCaster& rays, ExportOrder order,
                                        std::unique_ptr<gl::Context> context,
                                        const JobContext& job) {
    if (Status status = checkNotEmpty(order, opened, planned); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    addParameters(planned, order.settings);
    Result<render::DatasetOrigin> origin =
        originOf(planned.trajectory, rays, order.settings, order.still, opened, planned);
    if (!origin) return tl::unexpected(std::move(origin.error()));
    return render::FrameSeries::begin(std::move(context), *planned.scene, rays, planned.trajectory,
                                      planned.params.camera, std::move(order.settings),
                                      std::move(*origin), job);
}

nlohmann::json exportJson(const ExportOrder& order, const std::vector<ExportedDataset>& datasets,
                          const nlohmann::json& planned) {
    const std::string folder = order.settings.folder.string();
    if (datasets.size() == 1 && datasets.front().room.empty()) {
        return summaryJson(datasets.front().summary, folder, planned);
    }
    nlohmann::json rooms = nlohmann::json::array();
    render::PictureTally pictures;
    for (const ExportedDataset& one : datasets) {
        addTally(pictures, one.summary.pictures);
        rooms.push_back(summaryJson(one.summary, one.folder, planned));
        rooms.back()["room"] = one.room;
    }
    return roomsJson(folder, std::move(rooms), pictures);
}

}  // namespace dollytrack::cli
