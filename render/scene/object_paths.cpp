#include "render/scene/object_paths.h"

#include <algorithm>

namespace dollytrack::render {

ObjectPaths::ObjectPaths(const Scene& scene, const Trajectory& trajectory,
                         std::vector<ObjectMotion> motions)
    : motions_(std::move(motions)) {
    for (const TrajectoryFrame& frame : trajectory.frames) times_.push_back(frame.time_s);
    for (const ObjectMotion& motion : motions_) {
        middles_.push_back(scene.object(motion.object_id).box.center);
    }
}

std::vector<ObjectPaths::Placed> ObjectPaths::at(double time_s) const {
    std::vector<Placed> placed;
    if (times_.empty()) return placed;
    const auto above = std::ranges::upper_bound(times_, time_s);
    const auto after =
        std::min(static_cast<std::size_t>(above - times_.begin()), times_.size() - 1);
    const std::size_t before =
        above == times_.begin() ? 0 : static_cast<std::size_t>(above - times_.begin()) - 1;
    const double whole = times_[after] - times_[before];
    const double share = whole > 0.0 ? (time_s - times_[before]) / whole : 0.0;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
        const Eigen::Isometry3d& from = motions_[i].by_frame[before];
        const Eigen::Isometry3d& to = motions_[i].by_frame[after];
        const Eigen::Vector3d middle =
            (1.0 - share) * (from * middles_[i]) + share * (to * middles_[i]);
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(from.rotation()).slerp(share, Eigen::Quaterniond(to.rotation()));
        Placed& one = placed.emplace_back();
        one.object_id = motions_[i].object_id;
        one.motion = Eigen::Translation3d(middle) * turn * Eigen::Translation3d(-middles_[i]);
    }
    return placed;
}

}  // namespace dollytrack::render
