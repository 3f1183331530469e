#include "engine/io/homes/home_reader.h"
#include "engine/io/trajectories/pose_list.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack {
namespace {

/// Home axes are the plan's x, up, and the plan's y (down the page); a camera with yaw 0 looks down
/// the page, and turns clockwise on it.
FilePose poseOf(const homes::HomeCamera& camera) {
    FilePose pose;
    pose.position = {camera.position.x(), camera.height, camera.position.y()};
    const double flat = std::cos(camera.pitch);
    const Eigen::Vector3d forward(-std::sin(camera.yaw) * flat, -std::sin(camera.pitch),
                                  std::cos(camera.yaw) * flat);
    const Eigen::Vector3d right(-std::cos(camera.yaw), 0.0, -std::sin(camera.yaw));
    pose.rotation.col(0) = right;
    pose.rotation.col(1) = forward.cross(right);
    pose.rotation.col(2) = forward;
    return pose;
}

}  // namespace

// The views that a user placed in a Sweet Home 3D home. The visitor and the stored views are
// separate, the cameras of the video are one motion. The lens is that of the first view.
Result<PoseList> readSweetHome(const PoseFile& file) {
    const Result<homes::Home> home = homes::readHomeFile(file.text, file.path);
    if (!home) return tl::unexpected(home.error());
    PoseList list;
    int motion = 0;
    for (const homes::HomeCamera& camera : home->cameras) {
        FilePose pose = poseOf(camera);
        // The visitor's view is often equal to a stored one.
        const bool known = std::any_of(list.poses.begin(), list.poses.end(), [&](const auto& p) {
            return (p.position - pose.position).norm() < 1e-3 &&
                   (p.rotation - pose.rotation).norm() < 1e-6;
        });
        if (known && camera.kind != homes::CameraKind::Path) continue;
        if (!list.hfov_deg) list.hfov_deg = camera.field_of_view * 180.0 / std::numbers::pi;
        if (camera.kind != homes::CameraKind::Path) ++motion;
        pose.motion = camera.kind == homes::CameraKind::Path ? 0 : motion;
        list.poses.push_back(pose);
    }
    if (list.poses.empty()) {
        return fail(ErrorCode::BadInput,
                    "The home has no views of a visitor; store a point of view in Sweet Home 3D.",
                    file.path.string());
    }
    return list;
}

}  // namespace dollytrack
