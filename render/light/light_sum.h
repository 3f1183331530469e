#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/camera/lens_distortion.h"

namespace dollytrack::render {

/// What one look of many is to a sum of light.
struct LightSum {
    Intrinsics lens;            // of the pinhole that the sum is seen through
    LensDistortion distortion;  // from there to the sensor, whose rows have times of their own
    double s_per_bent = 0.0;    // from a row's y / z behind the lens to its time; 0: all at once
    double after_s = 0.0;       // the look's time, that of the middle row being 0
    double look_step_s = 0.0;   // to the next look
    double row_exposure_s = 0.0;
    int first_row = 0;  // of the sum; what lies outside need not be drawn
    int last_row = 0;   // the first that need not
};

}  // namespace dollytrack::render
