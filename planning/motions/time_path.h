#pragma once

#include "engine/camera/trajectory.h"
#include "engine/jobs/job.h"
#include "planning/motions/repair_path.h"
#include "planning/timing/motion_limits.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace dollytrack::planning {

class SweptSphere;

/// How repaired paths are timed.
struct PathTiming {
    MotionLimits limits;
    double frame_interval_s = 0.1;
    double smooth_over_s = 0.1;  // accelerations are over this time
    bool fixed_rate = true;      // otherwise frames between given ones may be nearer in time
    bool retime_all = false;     // otherwise only what was repaired or is over the limits
    // The camera looks at this point; otherwise as given, interpolated between frames.
    std::optional<Eigen::Vector3d> look_at = {};
};

/// Largest factor by which a given move may exceed a limit before it counts as over it: times in
/// files are rounded.
inline constexpr double kLimitTolerance = 1.02;

/// Whether the move to the next frame is faster, or turns faster, than the limits allow.
[[nodiscard]] bool isOverLimits(const TrajectoryFrame& from, const TrajectoryFrame& to,
                                const MotionLimits& limits);

/// Orientation of the camera at a point of a repaired path.
[[nodiscard]] Eigen::Quaterniond orientationAt(const PathPoint& point,
                                               std::span<const TrajectoryFrame> given,
                                               const PathTiming& timing);

/// The rotation from one orientation to another as a rotation vector in the world's axes, rad; at
/// most half a turn.
[[nodiscard]] Eigen::Vector3d rotationVector(const Eigen::Quaterniond& from,
                                             const Eigen::Quaterniond& to);

/// Frames along a repaired path, and for each of them the place along the given path that it stands
/// for: the number of a given frame, with a fraction between two of them.
struct TimedPath {
    std::vector<TrajectoryFrame> frames;
    std::vector<double> given_frames;
};

/// Frames along a repaired path. Given times are kept as far as the limits allow: repaired
/// stretches keep one frame for each given one if these are within the limits of speed, turning and
/// acceleration, or no more accelerated than the rest of the given path. Other repaired stretches,
/// and moves over the limits, take as much time as the limits ask, with ramps of speed to the rest,
/// and get new frames at the frame interval. The straight lines between frames are
/// proven to be collision-free. The first frame keeps its time. Empty if it would take more than
/// kMostMotionFrames, or if cancelled.
TimedPath timePath(const SweptSphere& sphere, const PathTiming& timing,
                   std::span<const TrajectoryFrame> given, std::vector<PathPoint> points,
                   const JobContext& job);

}  // namespace dollytrack::planning
