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

/// Camera shake over time: six values in -1..1, three translations along and three rotations about
/// the camera's own axes. The same seed gives the same shake at any frame rate.
class CameraShake {
  public:
    CameraShake(const ShakeParams& params, int seed);

    [[nodiscard]] Eigen::Matrix<double, 6, 1> at(double time_s) const;

  private:
    struct Wave {
        double share, radians_per_s, phase;
    };
    std::array<std::vector<Wave>, 6> waves_;
};

/// Shakes a trajectory timed on `paths`. Each move between frames (see moveBetween()) is proven
/// collision-free; where it collides the shake is reduced, down to none. It also fades out at both
/// ends of a path, at fixed points and at key frames that would lose a capture. Views steeper than
/// the pitch band are tilted back to its limit. Error: Cancelled.
Result<Trajectory> shakeTrajectory(const std::vector<SmoothPath>& paths, Trajectory trajectory,
                                   const std::vector<PositionPoint>& position_points,
                                   const ViewEstimator& views, const SweptSphere& sphere,
                                   const ShakeParams& params, const PitchBand& pitch, int seed,
                                   const JobContext& job);

}  // namespace dollytrack::planning
