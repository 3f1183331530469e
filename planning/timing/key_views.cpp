#include "planning/timing/key_views.h"

#include <algorithm>

namespace dollytrack::planning {

Eigen::Vector3d KeyViews::target(const SmoothPath::Key& key) const {
    if (key.position_point < 0) return key.looks_at;
    const PositionPoint& p = point(key);
    const auto& target = targets_[p.observation_point].position;
    if (!p.fixed && !pitch_.restricts()) return target;
    constexpr double kNearest_m = 0.1;
    const Pose at_key = pose(key);
    const double distance = std::max(kNearest_m, (target - at_key.position).norm());
    return at_key.position + distance * at_key.forward();
}

Pose KeyViews::pose(const SmoothPath::Key& key) const {
    if (key.position_point < 0) return aim(key.position, key.looks_at, pitch_);
    const PositionPoint& p = point(key);
    if (p.fixed) return {key.position, p.pose.rotation};
    // Smoothing moves other keys slightly; the camera turns to keep the target in the image centre.
    const auto& target = targets_[p.observation_point].position;
    return aim(key.position, target, pitch_);
}

}  // namespace dollytrack::planning
