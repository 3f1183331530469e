#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <functional>
#include <vector>

namespace dollytrack::planning {

class ViewCache;
struct RepairParams;
struct PlanningEnvironment;

[[nodiscard]] bool asksForRepair(const RepairParams& params);

/// A trajectory after segments of bad frames were planned again, the paths it was made from, and a
/// report.
struct RepairedTrajectory {
    std::vector<CameraPath> paths;
    std::vector<SmoothPath> smooth_paths;
    Trajectory trajectory;
    RepairReport report;
};

/// Functions that make trajectories from paths.
struct TrajectoryMaker {
    std::function<Result<SmoothPath>(const CameraPath&)> smooth;
    std::function<Result<Trajectory>(const std::vector<SmoothPath>&)> time;
    /// Times a part of a path, without any budget of frames or length.
    std::function<Result<Trajectory>(const SmoothPath&)> time_part;
};

/// Repairs frames that score low (paper, 3.2.4), in rounds. A run of such frames between two key
/// frames first gets a look-aside view (the paper's fine-tuning of poses); if that does not help, a
/// detour found by RRT*. A segment keeps a change only if fewer of its frames are low, their mean
/// score does not fall, and no object loses its capture. With `drop_low_frames`, frames still low
/// are removed, except key frames and those that a capture needs. Key frames keep their poses
/// unless a detour rounds their corner differently. `memo` may be null. Error: Cancelled.
Result<RepairedTrajectory> repairTrajectory(const RepairedTrajectory& found,
                                            const TrajectoryMaker& maker,
                                            const PlanningEnvironment& environment,
                                            const RepairParams& params, int seed,
                                            const JobContext& job, ViewCache* memo = nullptr);

}  // namespace dollytrack::planning
