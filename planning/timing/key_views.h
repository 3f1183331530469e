#pragma once

#include "engine/plan/camera_path.h"
#include "engine/plan/targets.h"
#include "engine/plan/viewpoint.h"
#include "planning/visibility/pitch_band.h"

#include <vector>

namespace dollytrack::planning {

/// The camera's poses at the keys of a smoothed path. Keeps references to its arguments.
class KeyViews {
  public:
    KeyViews(const std::vector<PositionPoint>& points, const std::vector<ObservationPoint>& targets,
             const PitchBand& pitch)
        : points_(points), targets_(targets), pitch_(pitch) {}

    /// The point that the camera looks at, world, m. For a fixed point or a limited pitch it lies
    /// on the actual viewing ray, at the target's distance.
    [[nodiscard]] Eigen::Vector3d target(const SmoothPath::Key& key) const;

    /// Pose at a key. The pitch limit is applied unless the point is fixed.
    [[nodiscard]] Pose pose(const SmoothPath::Key& key) const;

  private:
    [[nodiscard]] const PositionPoint& point(const SmoothPath::Key& key) const {
        return points_[key.position_point];
    }

    const std::vector<PositionPoint>& points_;
    const std::vector<ObservationPoint>& targets_;
    PitchBand pitch_;
};

}  // namespace dollytrack::planning
