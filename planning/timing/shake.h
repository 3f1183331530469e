#pragma once

#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "engine/plan/camera_path.h"
#include "engine/plan/viewpoint.h"
#include "planning/visibility/pitch_band.h"

#include <array>
#include <vector>

namespace dollytrack::planning {

class SweptSphere;
class ViewEstimator;
struct ShakeParams;

/// How a shaken camera sways: six numbers of -1..1 over time, of which three move it along its own
/// axes and three turn it about them. Equal seeds sway alike, whatever the frame rate.
class Sway {
  public:
    Sway(const ShakeParams& params, int seed);

    [[nodiscard]] Eigen::Matrix<double, 6, 1> at(double time_s) const;

  private:
    struct Wave {
        double share, radians_per_s, phase;
    };
    std::array<std::vector<Wave>, 6> waves_;
};

/// Shakes a trajectory timed on `paths`. Every move from frame to frame (moveBetween()) is proven
/// free again: where it would touch something the sway shrinks, down to none, and there the camera
/// keeps to its path. It fades
/// out towards both ends of a path, pinned points, and key frames that it would cost a capture.
/// Where the sway would look steeper than the band allows the camera is tilted back to its edge.
/// Error: Cancelled.
Result<Trajectory> shakeTrajectory(const std::vector<SmoothPath>& paths, Trajectory trajectory,
                                   const std::vector<PositionPoint>& position_points,
                                   const ViewEstimator& views, const SweptSphere& sphere,
                                   const ShakeParams& params, const PitchBand& pitch, int seed,
                                   const JobContext& job);

}  // namespace dollytrack::planning
