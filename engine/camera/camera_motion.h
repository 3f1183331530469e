#pragma once

#include "engine/camera/pose_spline.h"

#include <vector>

namespace dollytrack {

/// Where a camera is between the frames of its trajectory: on the same spline that inertial
/// measurements are taken from (pose_spline.h), one for each continuous path. Before a path's first
/// frame and after its last it goes straight on. Const, many threads.
class CameraMotion {
  public:
    explicit CameraMotion(const Trajectory& trajectory);

    /// The camera so long after a frame (before it: negative), on that frame's path; exactly the
    /// frame's pose at 0. A path of one frame stands still.
    [[nodiscard]] Pose poseAt(std::size_t frame, double after_s) const;

  private:
    struct Frame {
        TrajectoryFrame given;
        int path = -1;  // index in paths_; -1: alone
    };
    std::vector<Frame> frames_;
    std::vector<PoseSpline> paths_;
};

}  // namespace dollytrack
