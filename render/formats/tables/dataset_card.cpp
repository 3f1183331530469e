#include "render/formats/tables/dataset_card.h"

#include "engine/camera/intrinsics.h"
#include "engine/core/clean_text.h"
#include "engine/io/files/sha256.h"
#include "engine/io/settings/class_table_file.h"
#include "engine/plan/plan_json.h"
#include "engine/scene/resolved_light.h"
#include "engine/scene/scene_report.h"
#include "render/formats/poses/camera_json.h"
#include "render/formats/tables/fold_files.h"
#include "render/formats/tables/rig_card.h"

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Eigen::Vector3d& v) {
    return Json::array({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0});
}

Json toJson(const Eigen::Affine3d& transform) {
    Json rows = Json::array();
    const Eigen::Matrix4d matrix = transform.matrix();
    for (int row = 0; row < 4; ++row) {
        Json values = Json::array();
        for (int column = 0; column < 4; ++column) values.push_back(matrix(row, column) + 0.0);
        rows.push_back(values);
    }
    return rows;
}

Json conventions(const DatasetContents& contents, const DatasetCard& card) {
    const Intrinsics lens = makeIntrinsics(contents.camera);
    Json result = {
        {"length_unit", "m"},
        {"world", {{"handedness", "right"}, {"up", "z"}}},
        {"camera_axes", "x right, y down, z forward (OpenCV)"},
        {"pose", "world_from_camera: p_world = R(quaternion_xyzw) * p_camera + position"},
        {"quaternion_order", "x y z w"},
        {"matrix_order", "rows, applied to column vectors"},
        {"pixel_origin",
         "top left corner of the top left pixel; pixel (0, 0) has its centre at (0.5, 0.5)"},
        {"intrinsics",
         {{"width", lens.width},
          {"height", lens.height},
          {"fx", lens.fx},
          {"fy", lens.fy},
          {"cx", lens.cx},
          {"cy", lens.cy},
          {"hfov_deg", contents.camera.hfov_deg},
          {"near_m", contents.camera.near_m},
          {"distortion", "none"}}},
        {"labels", "of what the pixel's centre sees, never blended; glass counts as opaque"},
    };
    for (const Modality* modality : contents.modalities) {
        result[modality->name] = modality->convention(contents);
    }
    for (const Format* format : card.formats) result[format->name] = format->convention(contents);
    return result;
}

Json relationsOf(int object_id, const std::vector<ObjectRelation>& relations) {
    Json list = Json::array();
    for (const ObjectRelation& one : relations) {
        if (one.object_id == object_id) list.push_back({{"kind", one.kind}, {"id", one.other_id}});
    }
    return list;
}

Json objectTable(const Scene& scene, const std::vector<ObjectRelation>& relations) {
    Json table = Json::array();
    for (const Object& object : scene.objects) {
        Json row = {{"id", object.id}, {"name", object.name}, {"nyu40", object.nyu40}};
        if (!scene.classes().isNyu40()) row["class_id"] = scene.classes().classOf(object).id;
        row["role"] = roleName(object.role);
        row["box"] = {{"center", toJson(object.box.center)},
                      {"size", toJson(2.0 * object.box.half_size)},
                      {"yaw_rad", object.box.yaw}};
        row["relations"] = relationsOf(object.id, relations);
        table.push_back(std::move(row));
    }
    return table;
}

Json classRow(const DatasetClass& one) {
    return {{"id", one.id}, {"name", one.name}, {"color", one.color}};
}

/// The void class, then the classes in their order.
Json classTable(const ClassTable& classes) {
    Json table = Json::array({classRow(classes.voidClass())});
    for (const DatasetClass& one : classes.classes()) {
        table.push_back(classRow(one));
        if (!classes.isNyu40() && !one.supercategory.empty()) {
            table.back()["supercategory"] = one.supercategory;
        }
    }
    return table;
}

template <class Row>
Json namesOf(const std::vector<const Row*>& rows) {
    Json names = Json::array();
    for (const Row* row : rows) names.push_back(row->name);
    return names;
}

/// Transforms of the moving objects: p = rotation * p_in_scene + position, world frame.
Json movingTable(const std::vector<ObjectMotion>& motions, std::size_t frame) {
    Json table = Json::array();
    for (const ObjectMotion& motion : motions) {
        const Eigen::Isometry3d& now = motion.by_frame[frame];
        const Eigen::Quaterniond q(now.rotation());
        table.push_back({{"object_id", motion.object_id},
                         {"position", toJson(Eigen::Vector3d(now.translation()))},
                         {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}});
    }
    return table;
}

Json frameTable(const DatasetContents& contents) {
    const std::vector<DatasetFrame>& frames = contents.frames;
    Json table = Json::array();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const TrajectoryFrame& frame = frames[i].camera;
        const Eigen::Quaterniond& q = frame.pose.rotation;
        table.push_back({{"index", i},
                         {"trajectory_frame", frames[i].source_frame},
                         {"time_s", frame.time_s},
                         {"position", toJson(frame.pose.position)},
                         {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
                         {"component", frame.component}});
        if (!contents.motions.empty()) {
            table.back()["moving"] = movingTable(contents.motions, i);
        }
    }
    return table;
}

Json countedMetrics(const DatasetCard& card) {
    Json captures = Json::array();
    for (const ObjectCapture& capture : card.captures) {
        captures.push_back({{"object_id", capture.object_id},
                            {"captured", capture.captured},
                            {"well_captured", capture.well_captured},
                            {"best_frame", capture.best.frame},
                            {"visible_fraction", capture.best.visible_fraction},
                            {"box_share", capture.best.box_share},
                            {"mask_share", capture.best.mask_share}});
    }
    Json metrics = captureMetricsJson(card.counted);
    metrics["per_object"] = std::move(captures);
    return metrics;
}

}  // namespace

Json pictureTallyJson(const PictureTally& tally) {
    const auto rate = [&](std::size_t count) {
        return tally.pictures == 0 ? Json() : Json(static_cast<double>(count) / tally.pictures);
    };
    return {{"measured", tally.pictures},
            {"dark", tally.dark},
            {"white", tally.white},
            {"flat", tally.flat},
            {"dark_rate", rate(tally.dark.size())},
            {"white_rate", rate(tally.white.size())},
            {"flat_rate", rate(tally.flat.size())}};
}

PictureTally pictureTallyFrom(const Json& value) {
    PictureTally tally;
    tally.pictures = value.at("measured").get<int>();
    tally.dark = value.at("dark").get<std::vector<int>>();
    tally.white = value.at("white").get<std::vector<int>>();
    tally.flat = value.at("flat").get<std::vector<int>>();
    return tally;
}

Json datasetCardJson(const DatasetContents& contents, const DatasetCard& card) {
    const Scene& scene = contents.scene;
    const Json frames = frameTable(contents);
    Json root;
    root["format"] = kDatasetFormat;
    root["format_version"] = kDatasetVersion;
    root["product_version"] = card.product_version;
    root["modalities"] = namesOf(contents.modalities);
    root["formats"] = namesOf(card.formats);
    root["conventions"] = conventions(contents, card);
    if (contents.folds.count > 0) root["folds"] = foldConvention(contents);
    root["scene"] = {{"name", scene.name},
                     {"file", cleanText(scene.source.filename().string())},
                     {"sha256", scene.source_sha256},
                     {"geometry_sha256", card.geometry_sha256},
                     {"appearance_sha256", card.appearance_sha256},
                     {"source_from_world", toJson(scene.source_from_world)}};
    // Path of the scene for 'verify'. Scenes built in memory have no file.
    if (!scene.source.empty()) {
        const auto path = std::filesystem::absolute(scene.source).lexically_normal();
        root["scene"]["path"] = cleanText(path.string());
    }
    root["camera_json_from_world"] = toJson(Eigen::Affine3d(cameraJsonFromWorld(scene)));
    root["trajectory_sha256"] = sha256Of(std::string_view(frames.dump()));
    root["light"] = toJson(resolved(contents.light));
    root["whole_motion"] = {{"trajectory_sha256", card.whole_trajectory_sha256},
                            {"objects_sha256", card.whole_motions_sha256}};
    root["seed"] = card.seed;
    root["parameters"] = card.parameters;
    if (!card.edits.empty()) root["edits"] = card.edits;
    root["metrics"] = {{"planned", card.planned_metrics},
                       {"counted", countedMetrics(card)},
                       {"pictures", pictureTallyJson(card.pictures)}};
    root["objects"] = objectTable(scene, card.relations);
    root["classes"] = classTable(scene.classes());
    if (!scene.classes().isNyu40()) root["labels"] = classTableToJson(scene.classes());
    root["frames"] = frames;
    if (!contents.rig.empty()) root["cameras"] = rigCard(contents);
    root["files"] = card.sha256s;
    return root;
}

}  // namespace dollytrack::render
