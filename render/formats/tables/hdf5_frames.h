#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// HDF5 files as BlenderProc's, one a frame, in hdf5/.
extern const Format kHdf5FramesFormat;

}  // namespace dollytrack::render
