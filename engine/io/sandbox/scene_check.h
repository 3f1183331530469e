#pragma once

#include "engine/core/result.h"
#include "engine/io/sandbox/scene_frame.h"

namespace dollytrack::io {

/// Makes what another process read safe to work with: every index points at something that is
/// there, every number is finite and within its range, every part of the scene belongs to at most
/// one object; texts are made clean, bounds and areas measured. Error: BadInput, what is wrong.
[[nodiscard]] Status checkScene(ReadScene& scene);

}  // namespace dollytrack::io
