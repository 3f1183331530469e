#pragma once

#include "planning/motions/move_settings.h"
#include "planning/motions/repair_motion.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace dollytrack::planning {

/// A camera move that was made.
struct CameraMove {
    Trajectory trajectory;
    std::optional<Eigen::Vector3d> look_at;  // world, m; nullopt: it looks along its path
    double floor_z = 0.0;  // the floor that heights of its settings are above, world, m
    std::string note;      // a sentence on how obstacles changed the move; empty: not at all
};

/// Makes the move, free of collisions and within the motion limits: the ideal move where it is
/// free, repaired elsewhere (see repairMotion()). Where obstacles block an orbit, its radius,
/// height and arc are adapted. Errors: Usage for a value that cannot be read, with the setting's
/// name as `where`; BadInput if the object is unknown or there is no free space for the move;
/// Cancelled.
Result<CameraMove> makeMove(const MappedScene& scene, const PlanParams& params,
                            const MoveRequest& request, const JobContext& job);

}  // namespace dollytrack::planning
