#pragma once

#include "engine/camera/pose_spline.h"

#include <vector>

namespace dollytrack {

/// Where a camera is between the frames of its trajectory: on one spline (pose_spline.h) for each
/// continuous path, which motion blur and inertial measurements have in common. It passes the
/// frames left out, too. Before a path's first frame and after its last it goes straight on. Const,
/// many threads.
class CameraMotion {
  public:
    CameraMotion() = default;
    explicit CameraMotion(const Trajectory& trajectory);

    /// The path that a frame of the trajectory is on; null where it stands alone. As long as this.
    [[nodiscard]] const PoseSpline* pathOf(std::size_t frame) const;

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
