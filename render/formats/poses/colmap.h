#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// COLMAP's text model in sparse/0; points3D.txt has a sample of the surfaces in view, coloured, to
/// begin a reconstruction from. They have no tracks: nothing was matched.
extern const Format kColmapFormat;

}  // namespace dollytrack::render
