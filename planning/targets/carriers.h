#pragma once

#include "engine/plan/targets.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

struct TargetParams;

/// What holds an object, and how.
struct Carriage {
    TargetKind kind = TargetKind::Single;
    int carrier = 0;  // object id; structure counts with Suspension only; 0: none
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();  // Suspension: away from the carrier;
                                                        // Shelf: towards the open side
    bool small = false;
    /// What it stands on or hangs at, whatever its size; structure counts. 0: nothing near.
    int holder = 0;
    bool hangs = false;  // at the holder; else it stands on it
};

/// One entry an object of the scene, found by short rays below and around it.
std::vector<Carriage> findCarriers(const Scene& scene, const RayCaster& rays,
                                   const TargetParams& params);

}  // namespace dollytrack::planning
