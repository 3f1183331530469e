#include "engine/scene/light_check.h"

#include <fmt/format.h>

namespace dollytrack {

Status checkLight(const LightParams& params) {
    const double kelvin = params.lamp_temperature_K;
    if (kelvin == 0.0 || kelvin >= 1000.0) return {};
    return fail(ErrorCode::Usage,
                fmt::format("'{}' cannot be used; it must be 0, or 1000 .. 20000 K.", kelvin),
                "lamp_temperature_K");
}

}  // namespace dollytrack
