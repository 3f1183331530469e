#include "engine/scene/light_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack {
namespace {

constexpr double kColdest_K = 1000.0;

}  // namespace

Status checkLight(const LightParams& params) {
    const double kelvin = params.lamp_temperature_K;
    if (kelvin == 0.0 || kelvin >= kColdest_K) return {};
    return fail(ErrorCode::Usage,
                fmt::format("'{}' cannot be used; it must be 0, or 1000 .. 20000 K.", kelvin),
                "lamp_temperature_K");
}

LightParams raisedLight(LightParams params) {
    double& kelvin = params.lamp_temperature_K;
    if (kelvin != 0.0) kelvin = std::max(kelvin, kColdest_K);
    return params;
}

}  // namespace dollytrack
