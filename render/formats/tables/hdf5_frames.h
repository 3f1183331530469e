#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// HDF5 files in BlenderProc's layout, one per frame, in hdf5/.
extern const Format kHdf5FramesFormat;

}  // namespace dollytrack::render
