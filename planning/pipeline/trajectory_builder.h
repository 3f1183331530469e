#pragma once

#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/plan.h"
#include "planning/plan_params.h"
#include "planning/repair/repair.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <vector>

namespace dollytrack::planning {

/// Makes trajectories from camera paths with the parameters of one run: smoothing, context views,
/// timing. Keeps references to its arguments. Errors of all functions: Cancelled; Failed if a
/// budget of frames is too small.
class TrajectoryBuilder {
  public:
    /// `environment` limits where the camera may look from, `movement` where it may move. They are
    /// the same, unless each room has a trajectory of its own.
    TrajectoryBuilder(const PlanningEnvironment& environment, const PlanningEnvironment& movement,
                      const Viewpoints& viewpoints, const PlanParams& params,
                      const JobContext& job);

    [[nodiscard]] Result<SmoothPath> smooth(const CameraPath& path) const;
    [[nodiscard]] Result<std::vector<SmoothPath>> smooth(
        const std::vector<CameraPath>& paths) const;

    /// Inserts context views into `path`, one of `all`. The paths share the budget of frames in
    /// proportion to their numbers of keys.
    [[nodiscard]] SmoothPath withContext(const SmoothPath& path,
                                         const std::vector<SmoothPath>& all) const;
    [[nodiscard]] std::vector<SmoothPath> withContext(const std::vector<SmoothPath>& all) const;

    /// The trajectory with limited image motion, without repeats, and with the camera shake.
    [[nodiscard]] Result<Trajectory> time(std::vector<SmoothPath> paths,
                                          const TimingParams& timing) const;
    /// A trajectory along these paths, after smoothing and with context views, at the limits of
    /// motion; without context views if even that has more frames than the clip.
    [[nodiscard]] Result<Trajectory> timeAtLimits(const std::vector<CameraPath>& paths) const;

    /// Smoothing and timing as functions for repairTrajectory(). A repaired path shares the budget
    /// of frames with `paths`, to which the functions keep a reference.
    [[nodiscard]] TrajectoryMaker maker(const std::vector<SmoothPath>& paths) const;

  private:
    [[nodiscard]] Result<Trajectory> timeSteadily(const std::vector<SmoothPath>& paths,
                                                  const TimingParams& timing) const;
    void measureImageMotions(std::vector<SmoothPath>& paths, const TimingParams& timing) const;
    [[nodiscard]] Pose poseAt(const SmoothPath::Key& key) const;

    const PlanningEnvironment& environment_;
    const PlanningEnvironment& movement_;
    const std::vector<PositionPoint>& position_points_;
    const std::vector<ObservationPoint>& observation_points_;
    const PlanParams& params_;
    TimingParams timing_of_part_;  // a part of a clip has no duration of its own
    const JobContext& job_;
};

}  // namespace dollytrack::planning
