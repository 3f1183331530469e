#include "planning/pipeline/trajectory_builder.h"

#include "planning/gaze/context_views.h"
#include "planning/gaze/image_motion.h"
#include "planning/smoothing/smooth_path.h"
#include "planning/timing/clip.h"
#include "planning/timing/drop_repeats.h"
#include "planning/timing/key_views.h"
#include "planning/timing/shake.h"
#include "planning/timing/time_trajectory.h"

#include <algorithm>
#include <utility>

namespace dollytrack::planning {

TrajectoryBuilder::TrajectoryBuilder(const PlanningEnvironment& environment,
                                     const PlanningEnvironment& movement,
                                     const Viewpoints& viewpoints, const PlanParams& params,
                                     const JobContext& job)
    : environment_(environment),
      movement_(movement),
      position_points_(viewpoints.position_points),
      observation_points_(viewpoints.observation_points),
      params_(params),
      timing_of_part_(params.timing),
      job_(job) {
    timing_of_part_.keep_frame_rate = keepsFrameRate(params.timing);
    timing_of_part_.duration_s = 0.0;
}

Pose TrajectoryBuilder::poseAt(const SmoothPath::Key& key) const {
    return KeyViews(position_points_, observation_points_, environment_.pitch).pose(key);
}

Result<SmoothPath> TrajectoryBuilder::smooth(const CameraPath& path) const {
    return smoothPath(path, position_points_, observation_points_, movement_, params_.smoothing,
                      job_);
}

Result<std::vector<SmoothPath>> TrajectoryBuilder::smooth(
    const std::vector<CameraPath>& paths) const {
    std::vector<SmoothPath> smoothed;
    for (const CameraPath& path : paths) {
        auto made = smooth(path);
        if (!made) return tl::unexpected(std::move(made.error()));
        smoothed.push_back(std::move(*made));
    }
    return smoothed;
}

SmoothPath TrajectoryBuilder::withContext(const SmoothPath& path,
                                          const std::vector<SmoothPath>& all) const {
    std::size_t keys = 0;
    for (const SmoothPath& each : all) keys += each.keys.size();
    TimingParams share = params_.timing;
    if (share.max_frames > 0 && keys > path.keys.size()) {
        const double part = static_cast<double>(path.keys.size()) / static_cast<double>(keys);
        share.max_frames = std::max(1, static_cast<int>(share.max_frames * part));
    }
    const int first = path.keys.empty() ? -1 : path.keys.front().position_point;
    const bool pinned =
        first >= 0 && (position_points_[first].pin >= 0 || position_points_[first].fixed);
    return withContextViews(
        path, [this](const SmoothPath::Key& key) { return poseAt(key); }, environment_,
        params_.gaze, share, !pinned);
}

std::vector<SmoothPath> TrajectoryBuilder::withContext(const std::vector<SmoothPath>& all) const {
    std::vector<SmoothPath> made;
    for (const SmoothPath& path : all) made.push_back(withContext(path, all));
    return made;
}

void TrajectoryBuilder::measureImageMotions(std::vector<SmoothPath>& paths,
                                            const TimingParams& timing) const {
    // With a heading limit, timing adds keys of its own, which have no image motion.
    if (imageMotionLimit_rps(timing) <= 0.0 || environment_.heading.restricts()) return;
    for (SmoothPath& path : paths) {
        measureImageMotion(
            path, [this](const SmoothPath::Key& key) { return poseAt(key); }, environment_.views,
            environment_.pitch);
    }
}

Result<Trajectory> TrajectoryBuilder::timeSteadily(const std::vector<SmoothPath>& paths,
                                                   const TimingParams& timing) const {
    return timeTrajectory(paths, position_points_, observation_points_, timing, environment_.pitch,
                          environment_.heading);
}

Result<Trajectory> TrajectoryBuilder::time(std::vector<SmoothPath> paths,
                                           const TimingParams& timing) const {
    measureImageMotions(paths, timing);
    return timeSteadily(paths, timing)
        .and_then([&](Trajectory&& steady) -> Result<Trajectory> {
            if (timing.max_frames <= 0 || keepsFrameRate(timing)) return std::move(steady);
            return dropRepeats(std::move(steady), timing.max_repeat_rate, environment_.views, job_);
        })
        .and_then([&](Trajectory&& steady) {
            return shakeTrajectory(paths, std::move(steady), position_points_, environment_.views,
                                   movement_.sphere, params_.shake, environment_.pitch,
                                   params_.seed, job_);
        });
}

Result<Trajectory> TrajectoryBuilder::timeAtLimits(const std::vector<CameraPath>& paths) const {
    const auto timed = [&](std::vector<SmoothPath> smoothed) {
        measureImageMotions(smoothed, timing_of_part_);
        return timeSteadily(smoothed, timing_of_part_);
    };
    return smooth(paths).and_then(
        [&](const std::vector<SmoothPath>& smoothed) -> Result<Trajectory> {
            // Context views add frames, and take long to find on paths that are too long anyway.
            Result<Trajectory> without_context = timed(smoothed);
            if (!without_context || without_context->frames.size() >
                                        static_cast<std::size_t>(clipFrames(params_.timing))) {
                return without_context;
            }
            return timed(withContext(smoothed));
        });
}

TrajectoryMaker TrajectoryBuilder::maker(const std::vector<SmoothPath>& paths) const {
    return {
        [this, &paths](const CameraPath& path) {
            return smooth(path).map(
                [&](const SmoothPath& made) { return withContext(made, paths); });
        },
        [this](const std::vector<SmoothPath>& smoothed) { return time(smoothed, params_.timing); },
        [this](const SmoothPath& part) { return time({part}, timing_of_part_); }};
}

}  // namespace dollytrack::planning
