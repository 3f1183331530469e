#pragma once

#include "render/dataset/contents/frame_context.h"

#include <string>
#include <vector>

namespace dollytrack::render {

/// Warnings about rig cameras that collide: the plan keeps only the planned camera's sphere free.
/// One sentence per camera that has an object between itself and the planned camera, and one per
/// camera nearer to a surface than camera_radius_m, each with the first such frame and object.
[[nodiscard]] std::vector<std::string> rigWarnings(const FrameContext& context);

}  // namespace dollytrack::render
