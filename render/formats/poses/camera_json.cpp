#include "render/formats/poses/camera_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

Json vectorJson(const Eigen::Vector3d& v) {
    // Adding 0.0 turns -0 into 0, because some readers compare texts.
    return Json::array({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0});
}

}  // namespace

Eigen::Isometry3d cameraJsonFromWorld(const Scene& scene) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    const Eigen::Matrix3d linear = scene.source_from_world.linear();
    const double scale = linear.col(0).norm();
    // A mirrored source is not right-handed and gets the general frame.
    if (scene.report.up_axis == "y" && scale > 0.0 && linear.determinant() > 0.0) {
        result.linear() = linear / scale;
        result.translation() = scene.source_from_world.translation() / scale;
    } else {
        result.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    }
    return result;
}

std::string cameraJsonText(const Scene& scene, const CameraParams& camera, double far_m,
                           const std::vector<CameraEntry>& entries) {
    const Eigen::Isometry3d out_from_world = cameraJsonFromWorld(scene);
    Json root = Json::array();
    for (const CameraEntry& entry : entries) {
        const Pose& pose = entry.frame.pose;
        // The target is projected onto the viewing axis; otherwise it would contradict the pose.
        const Eigen::Vector3d offset = entry.frame.target_in_world - pose.position;
        const double along = std::max(offset.dot(pose.forward()), 0.1);
        const Eigen::Vector3d target = pose.position + along * pose.forward();
        root.push_back({{"pos", vectorJson(out_from_world * pose.position)},
                        {"target", vectorJson(out_from_world * target)},
                        {"fov", camera.hfov_deg},
                        {"fov_axis", "h"},
                        {"near", camera.near_m},
                        {"far", far_m},
                        {"up", vectorJson(out_from_world.linear() *
                                          (pose.rotation * -Eigen::Vector3d::UnitY()))},
                        {"width", camera.width_px},
                        {"height", camera.height_px},
                        {"time", entry.frame.time_s},
                        {"room", entry.room},
                        {"targets", entry.targets}});
    }
    return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

constexpr std::array<const char*, 1> kCameraJsonFiles = {"camera.json"};

/// Largest distance from a camera to a corner of the building; rendering has no far plane.
double farthestSight(const DatasetContents& contents) {
    const Eigen::AlignedBox3d& bounds = contents.scene.room_bounds;
    double far_m = 0.0;
    for (const DatasetFrame& frame : contents.frames) {
        for (int corner = 0; corner < 8 && !bounds.isEmpty(); ++corner) {
            const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
            far_m = std::max(far_m, (bounds.corner(type) - frame.camera.pose.position).norm());
        }
    }
    return far_m;
}

Result<std::vector<DatasetFile>> writeCameraJson(const DatasetContents& contents) {
    std::vector<CameraEntry> entries;
    for (const DatasetFrame& frame : contents.frames) {
        CameraEntry entry{frame.camera, frame.room, {}};
        for (const int id : frame.well_shown) {
            entry.targets.push_back(contents.scene.object(id).name);
        }
        entries.push_back(std::move(entry));
    }
    return std::vector<DatasetFile>{
        {kCameraJsonFiles[0], cameraJsonText(contents.scene, contents.camera,
                                             std::ceil(farthestSight(contents) + 1.0), entries)}};
}

nlohmann::ordered_json cameraJsonConvention(const DatasetContents& /*contents*/) {
    return {{"file", kCameraJsonFiles[0]},
            {"format", "3D-FRONT: y up, metres, horizontal fov in degrees"}};
}

}  // namespace

const Format kCameraJsonFormat = {
    .name = "camera_json",
    .text =
        "camera poses and the targets that each shows well, in 3D-FRONT's format, in camera.json",
    .group = ContentGroup::Poses,
    .standard = true,
    .files = kCameraJsonFiles,
    .write = writeCameraJson,
    .convention = cameraJsonConvention,
};

}  // namespace dollytrack::render
