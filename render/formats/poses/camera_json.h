#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/trajectory.h"
#include "engine/scene/scene.h"
#include "render/dataset/contents/format.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace dollytrack::render {

/// The frame of camera.json: right-handed, metres, y up. It is the source's own frame if that is
/// y-up, else (x, z, -y) of the world.
[[nodiscard]] Eigen::Isometry3d cameraJsonFromWorld(const Scene& scene);

/// One entry of camera.json.
struct CameraEntry {
    TrajectoryFrame frame;
    std::string room;                  // room name or number
    std::vector<std::string> targets;  // names of the objects that this frame shows well
};

/// The text of camera.json: 3D-FRONT's array of pos, target and fov (horizontal, degrees), extended
/// by near, far, up, width, height, fov_axis, time, room and targets.
[[nodiscard]] std::string cameraJsonText(const Scene& scene, const CameraParams& camera,
                                         double far_m, const std::vector<CameraEntry>& entries);

/// camera.json of a dataset.
extern const Format kCameraJsonFormat;

}  // namespace dollytrack::render
