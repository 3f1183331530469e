#pragma once

#include "engine/jobs/job.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/framing.h"

#include <vector>

namespace dollytrack::planning {

/// A place in the air of a room and how it shows an object, whether or not the camera may be there.
struct WhatIfPlace {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double clearance_m = 0.0;          // to the nearest surface; exact where `roomy` is false
    bool roomy = false;                // surfaces leave room for the camera's sphere
    Verdict allowed = Verdict::Legal;  // or NoGo or HeightBand
    double fill = 0.0;                 // see fillFrom(); infinite when it is too near
    ViewEstimator::Estimate seen;      // a coarse look, by the camera that looks at it

    [[nodiscard]] bool legal() const { return roomy && allowed == Verdict::Legal; }
};

/// Places all around an object, dense: directions times distances, then places at random in the
/// free space of the rooms. In a fixed order. Empty when cancelled.
std::vector<WhatIfPlace> whatIfPlaces(const Surroundings& around, const Subject& subject,
                                      int object_id, int seed, const JobContext& job);

}  // namespace dollytrack::planning
