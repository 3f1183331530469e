#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "planning/visibility/shown_surface.h"

#include <functional>

namespace dollytrack::planning {

/// Caches of the surfaces that frames show, coarse and fine, for trajectories of one scene that
/// share poses. Not thread-safe.
struct SurfaceSamplers {
    explicit SurfaceSamplers(const ViewEstimator& views)
        : coarse(views, SurfaceSampler::Detail::Coarse), fine(views) {}
    SurfaceSampler coarse;
    SurfaceSampler fine;
};

/// Times the trajectory again with at most `max_frames` frames, at least the fewest that are
/// possible; all key frames stay.
using TimeWithin = std::function<Result<Trajectory>(int max_frames)>;

/// Lowers the frame rate of a trajectory until at most `max_repeat_rate` of its frames show nothing
/// new (see TrajectoryMetrics). Uses at most 16 fine measurements, so the rate found may be
/// slightly too low. Unchanged if the limit is 1, if there are no key frames, or if no frame rate
/// was found that meets the limit, for example because the key frames alone exceed it. `least` is
/// the fewest frames that `time_within` can give. Errors: Cancelled, and those of `time_within`.
Result<Trajectory> dropRepeats(Trajectory trajectory, double max_repeat_rate, int least,
                               const TimeWithin& time_within, SurfaceSamplers& samplers,
                               const JobContext& job);

}  // namespace dollytrack::planning
