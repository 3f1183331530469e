#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"

#include <functional>
#include <vector>

namespace dollytrack::planning {

class ViewMemo;
struct RepairParams;
struct Surroundings;

[[nodiscard]] bool asksForRepair(const RepairParams& params);

/// A trajectory with what it was made from.
struct Repaired {
    std::vector<CameraPath> paths;
    std::vector<SmoothPath> smooth_paths;
    Trajectory trajectory;
    RepairReport report;
};

/// How paths become trajectories; repair makes them anew.
struct TrajectoryMaker {
    std::function<Result<SmoothPath>(const CameraPath&)> smooth;
    std::function<Result<Trajectory>(const std::vector<SmoothPath>&)> time;
    /// Times a part of a path, to which no budget of length applies.
    std::function<Result<Trajectory>(const SmoothPath&)> time_part;
};

/// Mends frames that score low (paper, 3.2.4), in rounds: where such frames follow each other
/// between two key frames the camera first glances at objects on its way (the paper's fine-tuning
/// of poses), and takes another way, found by RRT*, where that does not help. A stretch keeps its
/// change only when fewer of its frames are low and their mean score is no less. With
/// `drop_low_frames` those that still are low are left out. Key frames stay as they are, but where
/// another way rounds their corner otherwise, and no object that was captured, or captured well, is
/// lost. `memo`, unless null, remembers what frames show. Error: Cancelled.
Result<Repaired> repairTrajectory(const Repaired& found, const TrajectoryMaker& maker,
                                  const Surroundings& around, const RepairParams& params, int seed,
                                  const JobContext& job, ViewMemo* memo = nullptr);

}  // namespace dollytrack::planning
