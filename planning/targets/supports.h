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

/// The supporting surface of an object, and how it supports it.
struct SupportRelation {
    TargetKind kind = TargetKind::Single;
    int supporter = 0;  // id of the supporting object; structure only with Suspension; 0: none
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();  // Suspension: away from the supporter;
                                                        // Shelf: towards the open side; else zero
    bool small = false;
    /// Id of the object that it stands on or hangs from, whatever its size, structure included; 0:
    /// none within 6 cm.
    int holder = 0;
    bool hangs = false;  // hangs from the holder instead of standing on it
};

/// Finds the supporting surfaces of all targets, by short rays below and around each. One entry per
/// object of the scene, at index id - 1; entries of other objects are empty.
std::vector<SupportRelation> findSupports(const Scene& scene, const RayCaster& rays,
                                          const TargetParams& params);

}  // namespace dollytrack::planning
