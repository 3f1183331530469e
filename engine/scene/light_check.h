#pragma once

#include "engine/core/result.h"
#include "engine/scene/light_params.h"

namespace dollytrack {

/// What the fields' ranges do not say: lamps are of 1000 K at least, or 0. Error: Usage, naming the
/// field.
[[nodiscard]] Status checkLight(const LightParams& params);

/// What it takes, for a slider that leaves 0: lamps of less than 1000 K become lamps of that.
[[nodiscard]] LightParams raisedLight(LightParams params);

}  // namespace dollytrack
