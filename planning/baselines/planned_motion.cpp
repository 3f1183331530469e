#include "planning/baselines/planned_motion.h"

namespace dollytrack::planning {

std::vector<Eigen::Vector3d> wayToNext(const PlannedMotion& motion, std::size_t from) {
    const auto& frames = motion.trajectory.frames;
    if (from + 1 >= frames.size() || frames[from].path != frames[from + 1].path) return {};
    std::vector<Eigen::Vector3d> way = {frames[from].pose.position};
    if (from < motion.between.size()) {
        const auto& passed = motion.between[from];
        way.insert(way.end(), passed.begin(), passed.end());
    }
    way.push_back(frames[from + 1].pose.position);
    return way;
}

}  // namespace dollytrack::planning
