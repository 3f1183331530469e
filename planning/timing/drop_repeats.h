#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

namespace dollytrack::planning {

class ViewEstimator;

/// Leaves out frames that show nothing new (see TrajectoryMetrics), those with the least new
/// surface first, until at most `max_repeat_rate` of the frames show nothing new. The frames at
/// position points and both ends of each path stay. If leaving out all others does not suffice,
/// none is left out. Error: Cancelled.
Result<Trajectory> dropRepeats(Trajectory trajectory, double max_repeat_rate,
                               const ViewEstimator& views, const JobContext& job);

}  // namespace dollytrack::planning
