#pragma once

#include "engine/core/result.h"
#include "engine/io/sandbox/scene_serialization.h"

namespace dollytrack {

/// Checks a scene that another process read, so that it is safe to work with: every index is in
/// range, every number is finite and within its limits, and every part belongs to at most one
/// object. Cleans texts and measures bounds and areas. Error: BadInput, saying what is wrong.
[[nodiscard]] Status checkScene(DecodedScene& scene);

}  // namespace dollytrack
