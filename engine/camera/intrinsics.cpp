#include "engine/camera/intrinsics.h"

#include <cmath>
#include <numbers>

namespace dollytrack {

Intrinsics makeIntrinsics(const CameraParams& params) {
    const double half_fov = params.hfov_deg * std::numbers::pi / 360.0;
    const double focal = 0.5 * params.width_px / std::tan(half_fov);
    return {params.width_px, params.height_px,      focal,
            focal,           0.5 * params.width_px, 0.5 * params.height_px};
}

}  // namespace dollytrack
