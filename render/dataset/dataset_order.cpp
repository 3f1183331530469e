#include "render/dataset/dataset_order.h"

#include "engine/io/files/bounded_json.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"
#include "render/scene/motion_hash.h"
#include "render/scene/scene_hash.h"
#include "render/sensors/sensor_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace dollytrack::render {
namespace {

Result<nlohmann::json> parseJson(const std::string& text, const char* what) {
    Result<nlohmann::json> value = parseBoundedJson(text, what);
    if (!value) {
        return fail(ErrorCode::Failed,
                    std::string(what) + " passed to the export are not valid JSON");
    }
    return value;
}

std::vector<DatasetFrame> plannedFrames(const Trajectory& trajectory, const FrameRange& range) {
    std::vector<DatasetFrame> frames;
    for (const int source : framesOf(range, static_cast<int>(trajectory.frames.size()))) {
        DatasetFrame frame;
        frame.camera = trajectory.frames[source];
        frame.source_frame = source;
        frame.room = "room " + std::to_string(std::max(frame.camera.component, 0) + 1);
        frames.push_back(std::move(frame));
    }
    return frames;
}

/// The planned motions at the dataset's frames.
std::vector<ObjectMotion> motionsOf(const std::vector<DatasetFrame>& frames,
                                    const std::vector<ObjectMotion>& planned) {
    std::vector<ObjectMotion> motions;
    for (const ObjectMotion& motion : planned) {
        ObjectMotion& kept = motions.emplace_back(ObjectMotion{motion.object_id, {}});
        for (const DatasetFrame& frame : frames) {
            kept.by_frame.push_back(motion.by_frame[frame.source_frame]);
        }
    }
    return motions;
}

}  // namespace

Result<DatasetOrder> describeOrder(const Scene& scene, const CameraParams& camera,
                                   const Trajectory& trajectory, const DatasetSettings& settings,
                                   const DatasetOrigin& origin) {
    DatasetOrder order{{scene, camera, {}, plannedFrames(trajectory, settings.range)}, {}};
    if (order.contents.frames.empty()) {
        return fail(ErrorCode::Usage,
                    "the range contains none of the trajectory's " +
                        std::to_string(trajectory.frames.size()) + " frames",
                    "--range");
    }
    const Available available{!settings.rig.empty(),
                              settings.picture.render_mode != RenderMode::Fast};
    Result<ModalitySet> modalities = chooseModalities(settings.modalities, available);
    if (!modalities) return tl::unexpected(modalities.error());
    order.contents.modalities = std::move(*modalities);
    order.contents.camera_motion = CameraMotion(trajectory);
    order.contents.frame_interval_s = trajectory.frame_interval_s;
    order.contents.imu_rate_hz = settings.imu_rate_hz;
    for (const int distance : settings.flow_distances) {
        if (distance >= 1) continue;
        return fail(ErrorCode::Usage, "Flow distances are in frames and at least 1.",
                    "--flow-distances");
    }
    const bool has_flow =
        std::ranges::any_of(order.contents.modalities, &Modality::per_flow_distance);
    const int nearest =
        settings.flow_distances.empty() ? 1 : *std::ranges::min_element(settings.flow_distances);
    if (has_flow && nearest > 1 && nearest >= std::ssize(order.contents.frames)) {
        return fail(ErrorCode::Usage,
                    fmt::format("the {} frames are too few for a flow distance of {}",
                                order.contents.frames.size(), nearest),
                    "--flow-distances");
    }
    order.contents.flow_distances = settings.flow_distances;
    order.contents.stereo_baseline_m = settings.stereo_baseline_m;
    order.contents.motions = motionsOf(order.contents.frames, origin.motions);
    order.contents.sensor = settings.sensor;
    order.contents.light = settings.light;
    if (contains(order.contents.modalities, kRgbSensor)) {
        if (Status status = validateLens(camera, settings.sensor); !status) {
            return tl::unexpected(status.error());
        }
    }
    order.contents.score = settings.score;
    order.contents.folds = settings.folds;
    if (Status status = validate(settings.rig); !status) return tl::unexpected(status.error());
    order.contents.rig = settings.rig;
    const auto folds = splitFrames(order.contents.frames, settings.folds);
    if (!folds) return tl::unexpected(folds.error());
    DatasetCard& card = order.card;
    Result<FormatSet> formats = chooseFormats(settings.formats);
    if (!formats) return tl::unexpected(formats.error());
    card.formats = std::move(*formats);
    if (Status status = checkNeeds(card.formats, order.contents.modalities); !status) {
        return tl::unexpected(status.error());
    }
    Result<nlohmann::json> parameters = parseJson(origin.parameters_json, "the parameters");
    if (!parameters) return tl::unexpected(parameters.error());
    card.parameters = std::move(*parameters);
    Result<nlohmann::json> edits = parseJson(origin.edits_json, "the edits");
    if (!edits) return tl::unexpected(edits.error());
    card.edits = std::move(*edits);
    Result<nlohmann::json> metrics = parseJson(origin.planned_metrics_json, "the metrics");
    if (!metrics) return tl::unexpected(metrics.error());
    card.planned_metrics = std::move(*metrics);
    card.product_version = origin.product_version;
    card.relations = origin.relations;
    card.licenses = origin.licenses;
    card.seed = origin.seed;
    card.geometry_sha256 = geometryHash(scene);
    card.appearance_sha256 = appearanceHash(scene);
    card.whole_trajectory_sha256 = trajectoryHash(trajectory);
    card.whole_motions_sha256 = motionsHash(origin.motions);
    return order;
}

}  // namespace dollytrack::render
