#pragma once

#include "engine/io/import/raw_scene.h"

namespace dollytrack::homes {

/// OBJ models of Sweet Home 3D often name materials that no MTL file describes: they mean the
/// viewer's own palette ("flwhite", "dkgrey", "redwood"). Colours such materials after what their
/// names say; a name that says nothing keeps its grey.
void giveStandardColors(RawScene& model);

}  // namespace dollytrack::homes
