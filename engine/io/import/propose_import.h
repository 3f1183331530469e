#pragma once

#include "engine/io/orientation/frame_guess.h"
#include "engine/scene/scene.h"

namespace dollytrack {

/// Judges by gravity, known sizes of furniture and the room's height whether the scene was read
/// with the right unit and upward axis; `frame` is how they were chosen, with its doubts. What a
/// person has given is not doubted. Set `classes_by_shape` if walls and floors may have been
/// classified by their shape: that presumes an upward axis, so these classes are then not used as
/// evidence for it.
[[nodiscard]] ImportProposal proposeImport(const Scene& scene, const FrameChoice& frame,
                                           bool classes_by_shape);

}  // namespace dollytrack
