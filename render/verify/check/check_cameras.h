#pragma once

#include "render/verify/check.h"

namespace dollytrack::verify {

/// Checks the images and poses of a rig's cameras; see stored_rig.h.
CheckWork beginCameras(const Subject& subject, Findings& findings);

}  // namespace dollytrack::verify
