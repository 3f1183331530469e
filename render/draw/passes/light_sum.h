#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/camera/lens_distortion.h"

namespace dollytrack::render {

/// Timing and geometry of one exposure sample in an accumulated image.
struct LightSum {
    Intrinsics lens;             // pinhole camera in which light is accumulated
    LensDistortion distortion;   // of the sensor's lens; sensor rows have their own times
    double s_per_bent = 0.0;     // seconds per unit of distorted y / z; 0: global shutter
    double after_s = 0.0;        // time of the sample relative to the middle row, s
    double sample_step_s = 0.0;  // time to the next sample, s
    double row_exposure_s = 0.0;
    int first_row = 0;  // rows of the accumulated image that need drawing
    int last_row = 0;   // one past the last of these rows
};

}  // namespace dollytrack::render
