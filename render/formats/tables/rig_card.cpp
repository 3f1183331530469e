#include "render/formats/tables/rig_card.h"

#include "engine/camera/lens_model.h"

#include <nlohmann/json.hpp>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const Eigen::Vector3d& v) {
    return Json::array({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0});
}

Json poseJson(const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    return {{"position", numbers(pose.position)},
            {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

const char* formulaOf(Lens lens) {
    switch (lens) {
        case Lens::Pinhole:
            return "x = fx X / Z + cx, y = fy Y / Z + cy";
        case Lens::Fisheye:
            return "t = atan2(sqrt(X^2 + Y^2), Z), r = f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9), "
                   "x = r X / sqrt(X^2 + Y^2) + cx, y = r Y / sqrt(X^2 + Y^2) + cy, for t up to "
                   "fov_deg / 2 (Kannala and Brandt; OpenCV's fisheye with fx = fy = f; for "
                   "OpenCV, subtract 0.5 from cx and cy, because its pixel centres have integer "
                   "coordinates)";
        case Lens::Equirectangular:
            return "x = width (1/2 + atan2(X, Z) / 2 pi), "
                   "y = height (1/2 + atan2(Y, sqrt(X^2 + Z^2)) / pi)";
        case Lens::Orthographic:
            return "x = px_per_m X + cx, y = px_per_m Y + cy";
    }
    return "";
}

Json intrinsicsOf(const RigCamera& camera) {
    const LensModel lens(camera);
    const double cx = 0.5 * camera.width_px, cy = 0.5 * camera.height_px;
    Json result = {{"width", camera.width_px}, {"height", camera.height_px}};
    switch (camera.lens) {
        case Lens::Pinhole:
            result.update({{"fx", lens.focal()},
                           {"fy", lens.focal()},
                           {"cx", cx},
                           {"cy", cy},
                           {"hfov_deg", camera.fov_deg}});
            break;
        case Lens::Fisheye:
            result.update({{"f", lens.focal()},
                           {"cx", cx},
                           {"cy", cy},
                           {"k1", camera.k1},
                           {"k2", camera.k2},
                           {"k3", camera.k3},
                           {"k4", camera.k4},
                           {"fov_deg", camera.fov_deg}});
            break;
        case Lens::Equirectangular:
            break;
        case Lens::Orthographic:
            result.update({{"px_per_m", camera.px_per_m}, {"cx", cx}, {"cy", cy}});
            break;
    }
    return result;
}

Json depthOf(const RigCamera& camera) {
    const bool range = LensModel(camera).measuresRange();
    return {{"kind", range ? "range" : "planar"},
            {"scale_m", 0.001},
            {"invalid", 0},
            {"meaning", range ? "distance from the camera's centre along the ray"
                              : "distance along the viewing axis, not along the ray"}};
}

}  // namespace

Json rigCard(const DatasetContents& contents) {
    Json cameras = Json::array();
    for (const RigCamera& camera : contents.rig) {
        Json poses = Json::array();
        for (const DatasetFrame& frame : contents.frames) {
            poses.push_back(poseJson(poseOnRig(camera, frame.camera.pose)));
        }
        Json entry = {
            {"name", camera.name},
            {"lens", lensName(camera.lens)},
            {"intrinsics", intrinsicsOf(camera)},
            {"projection", formulaOf(camera.lens)},
            {"depth", depthOf(camera)},
            {"rides_on", camera.level
                             ? "a level frame at the planned camera's position and heading: x "
                               "horizontal along the camera's x axis, y down, z horizontal"
                             : "the planned camera"},
            {"level", camera.level},
            {"carrier_from_camera", poseJson(carrierFromCamera(camera))},
            {"settings", rigJson({camera}).front()},
            {"poses", std::move(poses)},  // world_from_camera, by frame
        };
        cameras.push_back(std::move(entry));
    }
    return cameras;
}

}  // namespace dollytrack::render
