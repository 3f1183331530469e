#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace dollytrack::planning {

struct MappedScene;
class MotionCheck;
struct FreeParts;

/// A corner of a repaired path.
struct PathPoint {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double frame = 0.0;          // of the given path; with a fraction between two frames
    bool repaired_next = false;  // the move to the next point differs from the given one
};

/// Collision-free polylines through one given path, one for each part into which it is cut because
/// no free way leads on. Every given frame has its point; free frames joined by free moves keep
/// their positions. Stretches between them are replaced by the nearest free way, around obstacles
/// or through doorways, relaxed towards the given motion (see relaxWay()). A short visit behind an
/// obstacle that would take a detour is given up. Empty if the path is nowhere near free space, or
/// if cancelled.
std::vector<std::vector<PathPoint>> repairPath(const MappedScene& scene, const MotionCheck& check,
                                               std::span<const TrajectoryFrame> frames,
                                               const FreeParts& parts, const JobContext& job);

}  // namespace dollytrack::planning
