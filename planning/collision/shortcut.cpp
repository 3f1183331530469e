#include "planning/collision/shortcut.h"

#include "planning/collision/swept_sphere.h"

namespace dollytrack::planning {

std::vector<Eigen::Vector3d> shortened(const std::vector<Eigen::Vector3d>& corners,
                                       const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                                       const SweptSphere& sphere) {
    std::vector<Eigen::Vector3d> all = {start};
    all.insert(all.end(), corners.begin(), corners.end());
    all.push_back(goal);
    std::vector<Eigen::Vector3d> kept;
    std::size_t from = 0;
    while (from + 1 < all.size()) {
        std::size_t to = all.size() - 1;
        while (to > from + 1 && !sphere.segment(all[from], all[to]).free) --to;
        if (to + 1 < all.size()) kept.push_back(all[to]);
        from = to;
    }
    return kept;
}

double wayLength(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& start,
                 const Eigen::Vector3d& goal) {
    double length = 0.0;
    Eigen::Vector3d last = start;
    for (const Eigen::Vector3d& corner : corners) {
        length += (corner - last).norm();
        last = corner;
    }
    return length + (goal - last).norm();
}

}  // namespace dollytrack::planning
