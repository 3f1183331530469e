#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// trajectory.glb: the scene, an object a node, and a camera that moves through it as the frames
/// do, for programs that open glTF 2.0.
extern const Format kGltfFormat;

}  // namespace dollytrack::render
