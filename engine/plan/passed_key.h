#pragma once

#include <string>

namespace dollytrack {

/// How the trajectory passes a key frame of the given camera motion (GivenMotion::keys).
struct PassedKey {
    int frame = 0;        // the nearest frame of the trajectory
    double time_s = 0.0;  // of that frame
    std::string note;  // what could not be kept and what to do, as a sentence; empty: all is kept
};

}  // namespace dollytrack
