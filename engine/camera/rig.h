#pragma once

#include "engine/core/field_list.h"
#include "engine/core/result.h"
#include "engine/math/pose.h"

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// How a camera of a rig turns directions into pixels; see LensModel.
enum class Lens {
    Pinhole,          // straight lines stay straight
    Fisheye,          // the angle from the axis is a distance in the image
    Equirectangular,  // all directions, by longitude and latitude
    Orthographic,     // parallel rays
};

/// A camera that rides on the planned one. Its place is in the planned camera's axes (x right,
/// y down, z forward); it is turned there by yaw, then pitch, then roll.
struct RigCamera {
    std::string name;  // letters, digits, _ and -; its folder in the dataset
    Lens lens = Lens::Pinhole;
    int width_px = 640;
    int height_px = 480;
    double fov_deg = 60.0;
    double k1 = 0.0;
    double k2 = 0.0;
    double k3 = 0.0;
    double k4 = 0.0;
    double px_per_m = 100.0;
    double right_m = 0.0;
    double down_m = 0.0;
    double forward_m = 0.0;
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
    bool level = false;

    bool operator==(const RigCamera&) const = default;
};

using Rig = std::vector<RigCamera>;

template <class Params, class Visitor>
void visitRigCamera(Params& p, Visitor&& visit) {
    visit("lens", p.lens,
          ChoiceInfo{{"pinhole", "fisheye", "equirectangular", "orthographic"},
                     "Projection of the lens"});
    visit("width_px", p.width_px, FieldInfo{16, 4096, "px", "Image width"});
    visit("height_px", p.height_px, FieldInfo{16, 4096, "px", "Image height"});
    visit("fov_deg", p.fov_deg,
          FieldInfo{10, 220, "deg", "Horizontal field of view; a fisheye sees nothing beyond it"});
    visit("k1", p.k1, FieldInfo{-10, 10, "", "Fisheye, after OpenCV: r = f (t + k1 t^3 + ...)"});
    visit("k2", p.k2, FieldInfo{-10, 10, "", "Fisheye: the factor of t^5"});
    visit("k3", p.k3, FieldInfo{-10, 10, "", "Fisheye: the factor of t^7"});
    visit("k4", p.k4, FieldInfo{-10, 10, "", "Fisheye: the factor of t^9"});
    visit("px_per_m", p.px_per_m, FieldInfo{1, 10000, "px/m", "Scale of the orthographic image"});
    visit("right_m", p.right_m,
          FieldInfo{-10, 10, "m", "Position, to the right of the planned camera"});
    visit("down_m", p.down_m, FieldInfo{-10, 10, "m", "Position, below the planned camera"});
    visit("forward_m", p.forward_m,
          FieldInfo{-10, 10, "m", "Position, in front of the planned camera"});
    visit("yaw_deg", p.yaw_deg, FieldInfo{-360, 360, "deg", "Rotation to the right"});
    visit("pitch_deg", p.pitch_deg, FieldInfo{-360, 360, "deg", "Upward tilt after yaw"});
    visit("roll_deg", p.roll_deg, FieldInfo{-360, 360, "deg", "Clockwise roll after pitch"});
    visit("level", p.level,
          SwitchInfo{"Follow only the position and heading of the planned camera and stay level, "
                     "however that camera is tilted"});
}

/// The fields but for the name. Points into `camera`.
[[nodiscard]] FieldList listRigCameraFields(RigCamera& camera);

/// What a camera of this lens is where nothing else is said; its name is empty.
[[nodiscard]] RigCamera standardCamera(Lens lens);

/// Whether a field of visitRigCamera() means anything to the lens.
[[nodiscard]] bool usesField(Lens lens, std::string_view field);

[[nodiscard]] std::string_view lensName(Lens lens);

/// Whether names are unique and can be folders, and each lens can be: a pinhole sees less than a
/// half-space, a fisheye's distances rise with the angle. Error: Usage, a sentence and
/// "camera 'left'".
[[nodiscard]] Status validate(const Rig& rig);

/// The camera in the axes that carry it: p_carrier = rotation * p_camera + position. The carrier is
/// the planned camera, or that one levelled.
[[nodiscard]] Pose carrierFromCamera(const RigCamera& camera);

/// Where the camera is, world_from_camera, when the planned one is at `planned`.
[[nodiscard]] Pose poseOnRig(const RigCamera& camera, const Pose& planned);

/// The cameras as a list of objects, as rig files have them; what a lens does not use is left out.
[[nodiscard]] nlohmann::json rigJson(const Rig& rig);

}  // namespace dollytrack
