#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// trajectory.glb: a glTF 2.0 file of the scene, one node per object, with a camera animated along
/// the frames.
extern const Format kGltfFormat;

}  // namespace dollytrack::render
