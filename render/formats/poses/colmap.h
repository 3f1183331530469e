#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// COLMAP's text model in sparse/0. points3D.txt contains coloured samples of the visible surfaces,
/// to initialise a reconstruction; they have no tracks.
extern const Format kColmapFormat;

}  // namespace dollytrack::render
