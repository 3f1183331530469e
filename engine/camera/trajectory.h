#pragma once

#include "engine/math/pose.h"

#include <cstddef>
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

/// Frames at a fixed rate, except where some were left out: the times tell. Where `path` changes
/// from one frame to the next the camera was carried over: there is no motion between the two.
struct Trajectory {
    double frame_interval_s = 0.1;
    std::vector<TrajectoryFrame> frames;
};

/// Whether frame `i` belongs to the same path as the frame before; frames may be left out between.
[[nodiscard]] inline bool continuesPath(const Trajectory& trajectory, std::size_t i) {
    return i > 0 && trajectory.frames[i].path == trajectory.frames[i - 1].path;
}

/// Whether the camera moved on to frame `i` from the frame before within one frame interval.
[[nodiscard]] inline bool followsOn(const Trajectory& trajectory, std::size_t i) {
    if (!continuesPath(trajectory, i)) return false;
    return trajectory.frames[i].time_s - trajectory.frames[i - 1].time_s <
           1.5 * trajectory.frame_interval_s;
}

}  // namespace dollytrack
