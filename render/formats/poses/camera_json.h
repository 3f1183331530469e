#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/trajectory.h"
#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace dollytrack::render {

/// The frame of camera.json: right-handed metres, y up; the source's own axes when it is y-up,
/// else (x, z, -y).
[[nodiscard]] Eigen::Isometry3d cameraJsonFromWorld(const Scene& scene);

/// One entry of camera.json.
struct CameraEntry {
    TrajectoryFrame frame;
    std::string room;                  // name of the room, or its number
    std::vector<std::string> targets;  // names of the objects this frame shows well
};

/// The text of camera.json: 3D-FRONT's array of pos, target and fov (horizontal, degrees), with
/// near, far, up, width, height, fov_axis, time, room and targets added.
[[nodiscard]] std::string cameraJsonText(const Scene& scene, const CameraParams& camera,
                                         double far_m, const std::vector<CameraEntry>& entries);

}  // namespace dollytrack::render
