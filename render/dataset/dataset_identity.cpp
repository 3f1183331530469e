#include "render/dataset/dataset_identity.h"

#include "engine/io/files/sha256.h"
#include "engine/io/settings/class_table_file.h"
#include "render/scene/exact_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace dollytrack::render {
namespace {

std::string sceneText(const Scene& scene, const DatasetCard& card) {
    std::string result = scene.name + "\n" + scene.source.filename().string() + "\n" +
                         scene.source_sha256 + card.geometry_sha256 + card.appearance_sha256 +
                         exactText(scene.room_bounds.min()) + exactText(scene.room_bounds.max());
    for (int column = 0; column < 4; ++column) {
        result += exactText(scene.source_from_world.matrix().col(column));
    }
    if (!scene.classes().isNyu40()) result += classTableToJson(scene.classes()).dump();
    for (const Object& object : scene.objects) {
        result += fmt::format("\n{} {} {} {}", object.id, static_cast<int>(object.role),
                              object.first_triangle, object.triangle_count) +
                  exactText(object.box.center) + exactText(object.box.half_size) +
                  fmt::format(" {}", object.box.yaw);
    }
    return result;
}

std::string roomsText(const DatasetOrigin& origin) {
    std::string result;
    for (const Eigen::AlignedBox3d& room : origin.rooms) {
        result += exactText(room.min()) + exactText(room.max());
    }
    return result;
}

template <class Row>
std::string names(const std::vector<const Row*>& rows) {
    std::string result;
    for (const Row* row : rows) result += std::string(row->name) + " ";
    return result;
}

std::string toText(const ScoreWeights& score) {
    return fmt::format("{} {} {} {}", score.separation, score.continuity, score.window,
                       score.squared);
}

/// Increase it when lighting changes: frames lit differently must not be mixed in one dataset.
constexpr int kLight = 5;

std::string pictureText(const PictureParams& picture) {
    return picture.render_mode == RenderMode::Fast
               ? fmt::format("light {} fast {} {} {}", kLight, static_cast<int>(picture.antialias),
                             static_cast<int>(picture.reflections), picture.anisotropy)
           : picture.render_mode == RenderMode::Traced
               ? fmt::format("light {} traced {}", kLight, picture.traced_samples)
               : fmt::format("light {} reference {}", kLight, picture.reference_samples);
}

std::string sensorText(const DatasetContents& contents, SensorParams params) {
    const bool pictures = contains(contents.modalities, kRgbSensor);
    if (!pictures && !contains(contents.modalities, "depth_sensor")) return "none";
    std::string result;
    for (const Field& field : listSensorFields(params)) result += field.valueText() + " ";
    return result;
}

std::string lightText(LightParams params) {
    std::string result;
    for (const Field& field : listLightFields(params)) result += field.valueText() + " ";
    return result;
}

}  // namespace

DatasetIdentity identityOf(const DatasetOrder& order, const DatasetSettings& settings,
                           const DatasetOrigin& origin) {
    const DatasetContents& contents = order.contents;
    const auto hash = [](const std::string& of) { return sha256Of(std::string_view(of)); };
    const CameraParams& camera = contents.camera;
    const CaptureRules& rules = settings.rules;
    return {
        {"the scene", hash(sceneText(contents.scene, order.card))},
        {"the rooms", hash(roomsText(origin))},
        {"the trajectory", order.card.whole_trajectory_sha256},
        {"the frame range", toText(settings.range)},
        {"the camera", fmt::format("{} {} {} {}", camera.width_px, camera.height_px,
                                   camera.hfov_deg, camera.near_m)},
        {"the capture rules", fmt::format("{} {} {}", rules.min_visible_fraction,
                                          rules.min_visible_px, rules.min_box_share)},
        {"the rate of inertial measurements", fmt::format("{}", settings.imu_rate_hz)},
        {"the distances of optical flow",
         fmt::format("{}", fmt::join(settings.flow_distances, " "))},
        {"the stereo baseline", fmt::format("{}", settings.stereo_baseline_m)},
        {"the way pictures are made", pictureText(settings.picture)},
        {"the light", lightText(settings.light)},
        {"the sensors", sensorText(contents, settings.sensor)},
        {"the motions of objects", order.card.whole_motions_sha256},
        {"the weights of the image score", toText(settings.score)},
        {"the modalities", names(contents.modalities)},
        {"the formats", names(order.card.formats)},
        {"the cameras of the rig", rigJson(contents.rig).dump()},
        {"the folds", fmt::format("{} {}", settings.folds.count, settings.folds.seed)},
        {"the parameters", hash(fmt::format("{} {}", origin.seed, origin.parameters_json))},
        {"the edits", hash(origin.edits_json)},
        {"the scene's licences", hash(origin.licenses)},
        {"the planned metrics", hash(origin.planned_metrics_json)},
        {"the program's version", origin.product_version},
    };
}

}  // namespace dollytrack::render
