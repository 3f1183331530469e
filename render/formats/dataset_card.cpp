#include "render/formats/dataset_card.h"

#include "engine/camera/intrinsics.h"
#include "engine/core/clean_text.h"
#include "engine/io/sha256.h"
#include "engine/scene/labels.h"
#include "render/formats/camera_json.h"

#include <span>

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

std::string roleName(Role role) {
    switch (role) {
        case Role::Target:
            return "target";
        case Role::Structure:
            return "structure";
        case Role::Excluded:
            break;
    }
    return "excluded";
}

template <class T>
std::span<const std::uint8_t> bytesOf(const std::vector<T>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

std::string geometryHash(const Scene& scene) {
    io::Sha256 hash;
    hash.add(bytesOf(scene.positions));
    hash.add(bytesOf(scene.triangles));
    for (const Object& object : scene.objects) {
        hash.add(object.name + "\n" + std::to_string(object.nyu40) + "\n");
    }
    return hash.finish();
}

Json conventions(const DatasetCard& card) {
    const Intrinsics lens = makeIntrinsics(card.camera);
    return {
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
          {"hfov_deg", card.camera.hfov_deg},
          {"near_m", card.camera.near_m},
          {"distortion", "none"}}},
        {"rgb", {{"folder", "rgb"}, {"type", "uint8 x 3"}, {"encoding", "sRGB"}}},
        {"depth",
         {{"folder", "depth"},
          {"type", "uint16"},
          {"kind", "planar"},
          {"scale_m", 0.001},
          {"invalid", 0},
          {"max_m", 65.535},
          {"meaning", "distance along the viewing axis, not along the ray"}}},
        {"instance",
         {{"folder", "instance"}, {"type", "uint16"}, {"invalid", 0}, {"meaning", "objects[].id"}}},
        {"semantic",
         {{"folder", "semantic"}, {"type", "uint8"}, {"invalid", 0}, {"meaning", "NYU40 class"}}},
        {"labels", "of what the pixel's centre sees, never blended; glass counts as opaque"},
        {"annotations",
         {{"file", "annotations.json"},
          {"format",
           "COCO instances, compressed run lengths; targets only; category_id is the "
           "NYU40 class (40 for targets of unknown class); image_id is the frame + 1"}}},
        {"camera_json",
         {{"file", "camera.json"}, {"format", "3D-FRONT: y up, metres, fov horizontal degrees"}}},
    };
}

Json objectTable(const Scene& scene) {
    Json table = Json::array();
    for (const Object& object : scene.objects) {
        table.push_back({{"id", object.id},
                         {"name", object.name},
                         {"nyu40", object.nyu40},
                         {"role", roleName(object.role)},
                         {"box",
                          {{"center", toJson(object.box.center)},
                           {"size", toJson(2.0 * object.box.half_size)},
                           {"yaw_rad", object.box.yaw}}}});
    }
    return table;
}

Json classTable() {
    Json table = Json::array();
    for (int nyu40 = 0; nyu40 <= kNyu40Count; ++nyu40) {
        const auto color = nyu40Color(nyu40);
        table.push_back(
            {{"id", nyu40}, {"name", nyu40Name(nyu40)}, {"color", {color[0], color[1], color[2]}}});
    }
    return table;
}

Json frameTable(const DatasetCard& card) {
    Json table = Json::array();
    for (std::size_t i = 0; i < card.frames.size(); ++i) {
        const TrajectoryFrame& frame = card.frames[i];
        const Eigen::Quaterniond& q = frame.pose.rotation;
        table.push_back({{"index", i},
                         {"trajectory_frame", card.source_frames[i]},
                         {"time_s", frame.time_s},
                         {"position", toJson(frame.pose.position)},
                         {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
                         {"component", frame.component}});
    }
    return table;
}

Json countedMetrics(const DatasetCard& card) {
    const CaptureMetrics& m = card.counted;
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
    return {{"objects", m.objects},
            {"captured", m.captured},
            {"well_captured", m.well_captured},
            {"capture_rate", m.capture_rate},
            {"well_captured_rate", m.well_captured_rate},
            {"small_capture_rate", m.small_capture_rate},
            {"area_share_box", m.area_share_box},
            {"area_share_mask", m.area_share_mask},
            {"per_object", captures}};
}

}  // namespace

std::string datasetCardText(const Scene& scene, const DatasetCard& card) {
    const Json frames = frameTable(card);
    Json root;
    root["format"] = kDatasetFormat;
    root["format_version"] = 1;
    root["product_version"] = card.product_version;
    root["conventions"] = conventions(card);
    root["scene"] = {{"name", scene.name},
                     {"file", cleanText(scene.source.filename().string())},
                     {"sha256", scene.source_sha256},
                     {"geometry_sha256", geometryHash(scene)},
                     {"source_from_world", toJson(scene.source_from_world)}};
    root["camera_json_from_world"] = toJson(Eigen::Affine3d(cameraJsonFromWorld(scene)));
    root["trajectory_sha256"] = io::sha256Of(std::string_view(frames.dump()));
    root["seed"] = card.seed;
    root["parameters"] = card.parameters;
    root["metrics"] = {{"planned", card.planned_metrics}, {"counted", countedMetrics(card)}};
    root["objects"] = objectTable(scene);
    root["classes"] = classTable();
    root["frames"] = frames;
    root["files"] = card.sha256s;
    return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dollytrack::render
