#pragma once

#include "engine/math/pose.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dollytrack {

/// One image to be taken.
struct TrajectoryFrame {
    double time_s = 0.0;
    Pose pose;                                                  // world_from_camera
    Eigen::Vector3d target_in_world = Eigen::Vector3d::Zero();  // a point the camera looks at
    int component = 0;        // free-space component (room) the frame is in
    int path = 0;             // which continuous motion it belongs to
    double arc_m = 0.0;       // how far along its smoothed path, where it has one
    int position_point = -1;  // index into Plan::position_points when it stands on a key frame
};

/// Frames at a fixed rate. With a budget some are left out, so that steps of `time_s` differ; times
/// never decrease. Where `path` changes from one frame to the next, there is no motion
/// between the two.
struct Trajectory {
    double frame_interval_s = 0.1;  // before frames were left out
    std::vector<TrajectoryFrame> frames;
    std::vector<TrajectoryFrame> left_out = {};  // by time; on the way of the camera, but no images
};

/// Time from the first frame to the end of the last one, s.
[[nodiscard]] double durationOf(const Trajectory& trajectory);

/// The median time from one frame to the next on the same path, s; none without such frames.
[[nodiscard]] std::optional<double> medianStep_s(const std::vector<TrajectoryFrame>& frames);

/// All frames of the motion in order of time, as indices: those from frames.size() on are of
/// `left_out`.
[[nodiscard]] std::vector<std::size_t> motionOrder(const Trajectory& trajectory);

/// The frame with an index of motionOrder().
[[nodiscard]] const TrajectoryFrame& motionFrame(const Trajectory& trajectory, std::size_t index);

/// All frames of the motion, in order of time.
[[nodiscard]] std::vector<TrajectoryFrame> motionFrames(const Trajectory& trajectory);

/// Moves the frames whose `keep` is 0 to `left_out`; `keep` has one entry for each frame.
[[nodiscard]] Trajectory keepOnly(const Trajectory& trajectory, const std::vector<char>& keep);

/// Whether frame `i` belongs to the same path as the frame before; frames may be left out between.
[[nodiscard]] inline bool continuesPath(const Trajectory& trajectory, std::size_t i) {
    return i > 0 && trajectory.frames[i].path == trajectory.frames[i - 1].path;
}

}  // namespace dollytrack
