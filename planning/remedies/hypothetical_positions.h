#pragma once

#include "engine/jobs/job.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/framing.h"

#include <vector>

namespace dollytrack::planning {

/// A position in the air of a room and the view of an object from it, whether or not the camera may
/// be there.
struct HypotheticalPosition {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double clearance_m = 0.0;          // to the nearest surface, m; exact if `roomy` is false
    bool roomy = false;                // whether surfaces leave room for the camera sphere
    Verdict allowed = Verdict::Legal;  // Legal, or the region's verdict, such as NoGo or HeightBand
    double fill = 0.0;                 // see fillFrom(); infinite if too close
    ViewEstimator::Estimate seen;      // coarse estimate, aimed at the object

    [[nodiscard]] bool legal() const { return roomy && allowed == Verdict::Legal; }
};

/// Dense positions around an object: many directions and distances, then random positions in the
/// rooms' free space, regardless of no-go boxes and height band. In a fixed order. Empty if
/// cancelled.
std::vector<HypotheticalPosition> hypotheticalPositions(const PlanningEnvironment& environment,
                                                        const Subject& subject, int object_id,
                                                        int seed, const JobContext& job);

}  // namespace dollytrack::planning
