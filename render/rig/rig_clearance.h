#pragma once

#include "render/frames/frame_context.h"

#include <string>
#include <vector>

namespace dollytrack::render {

/// What is wrong with where the rig's cameras are: only the planned camera's sphere is kept free.
/// A sentence a camera that has something between itself and the planned camera, or comes nearer
/// to a surface than the planned one's radius, with the first such frame and object.
[[nodiscard]] std::vector<std::string> rigWarnings(const FrameContext& context);

}  // namespace dollytrack::render
