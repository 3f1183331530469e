#include "engine/camera/intrinsics.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace dollytrack {

Intrinsics makeIntrinsics(const CameraParams& params) {
    const double half_fov = params.hfov_deg * std::numbers::pi / 360.0;
    const double focal = 0.5 * params.width_px / std::tan(half_fov);
    return {params.width_px, params.height_px,      focal,
            focal,           0.5 * params.width_px, 0.5 * params.height_px};
}

Status validate(const CameraParams& params) {
    const Intrinsics lens = makeIntrinsics(params);
    const double corner = params.near_m * lens.unproject(0.0, 0.0).norm();
    if (corner <= params.camera_radius_m) return {};
    return fail(ErrorCode::Usage,
                fmt::format("The near plane's corners are {:.3f} m from the camera, outside its "
                            "sphere of {:.3f} m: near_m {:g} is too large for hfov_deg {:g}; lower "
                            "near_m or hfov_deg, or raise camera_radius_m.",
                            corner, params.camera_radius_m, params.near_m, params.hfov_deg),
                "near_m, hfov_deg");
}

}  // namespace dollytrack
