#pragma once

#include "engine/io/raw_scene/raw_scene.h"

namespace dollytrack::homes {

/// Sets the colours of materials without a description by their names. OBJ models of Sweet Home 3D
/// often refer to a built-in palette ("flwhite", "dkgrey", "redwood") that no MTL file contains.
/// Materials with other names stay grey.
void giveStandardColors(RawScene& model);

}  // namespace dollytrack::homes
