#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/metrics/shown_surface.h"

#include <functional>

namespace dollytrack::planning {

/// What frames were found to show: poses that trajectories of one scene share are looked at once.
/// For one thread.
struct FrameLooks {
    explicit FrameLooks(const ViewEstimator& views)
        : glances(views, SurfaceLooks::Detail::Glance), closer(views) {}
    SurfaceLooks glances;
    SurfaceLooks closer;
};

/// Makes the trajectory anew with at most so many frames; key frames all stay.
using TimeWithin = std::function<Result<Trajectory>(int max_frames)>;

/// Lowers the frame rate of a trajectory until few of its frames show nothing new, at the most
/// `max_repeat_rate` of them as far as a dozen looks can tell, or only key frames are left:
/// pictures between two views that show the same as both cost rendering and teach nothing. Errors:
/// Cancelled, and those of `time_within`.
Result<Trajectory> dropRepeats(Trajectory trajectory, double max_repeat_rate,
                               const TimeWithin& time_within, FrameLooks& looks,
                               const JobContext& job);

}  // namespace dollytrack::planning
