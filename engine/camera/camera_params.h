#pragma once

#include "engine/core/fields.h"
#include "engine/core/result.h"

namespace dollytrack {

/// The camera: its image, its lens, and the sphere that holds it.
struct CameraParams {
    int width_px = 640;
    int height_px = 480;
    double hfov_deg = 60.0;
    double near_m = 0.05;
    double camera_radius_m = 0.10;

    bool operator==(const CameraParams&) const = default;
};

/// Whether the camera's sphere holds its near plane; else frames would look into what the sphere
/// keeps clear of. Error: Usage, naming the field.
Status validate(const CameraParams& params);

template <class Params, class Visitor>
void visitCameraParams(Params& p, Visitor&& visit) {
    visit("width_px", p.width_px, FieldInfo{16, 8192, "px", "Image width", "r"});
    visit("height_px", p.height_px, FieldInfo{16, 8192, "px", "Image height", "r"});
    visit("hfov_deg", p.hfov_deg, FieldInfo{10, 150, "deg", "Horizontal field of view", "v"});
    visit("near_m", p.near_m, FieldInfo{0.001, 1, "m", "Distance of the near plane"});
    visit("camera_radius_m", p.camera_radius_m,
          FieldInfo{0.01, 1, "m", "Radius of the camera, a sphere that must stay in free space"});
}

}  // namespace dollytrack
