#pragma once

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace dollytrack {

/// How an observation point came about (paper, 3.2.1 and 3.2.2).
enum class TargetKind {
    Single,      // one object by itself, seen from its front
    Support,     // small objects standing on a larger one, seen from above
    Suspension,  // a small object hanging on a wall or on a larger object
    Shelf,       // small objects inside a larger one, seen through its open side
};

std::string_view name(TargetKind kind);

/// What the camera looks at: O in the paper. The centre of an object or of a group.
struct ObservationPoint {
    TargetKind kind = TargetKind::Single;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();    // m, world
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // unit, from the target to the camera
    std::vector<int> objects;                              // ids of those it stands for
    int supporter = 0;  // id of the object that they stand on or hang on; 0: none or structure

    bool operator==(const ObservationPoint&) const = default;
};

}  // namespace dollytrack
