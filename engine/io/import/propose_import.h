#pragma once

#include "engine/io/orientation/frame_guess.h"
#include "engine/scene/scene.h"

namespace dollytrack {

/// Estimates by gravity, typical furniture sizes and the room's height whether the scene was read
/// with the right unit and up axis, and proposes others if not. `frame` describes how they were
/// chosen. Values given by the user are not questioned. Set `classes_by_shape` if walls and floors
/// may have been classified by shape: this assumes an up axis, so these classes are then not used
/// as evidence for it.
[[nodiscard]] ImportProposal proposeImport(const Scene& scene, const FrameChoice& frame,
                                           bool classes_by_shape);

}  // namespace dollytrack
