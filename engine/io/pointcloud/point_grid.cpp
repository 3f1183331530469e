#include "engine/io/pointcloud/point_grid.h"

#include <algorithm>
#include <numeric>

namespace dollytrack {

PointGrid::PointGrid(std::span<const Eigen::Vector3d> points, double cell)
    : points_(points), cell_(cell), order_(points.size()) {
    std::vector<std::uint64_t> keys(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        keys[i] = keyOf((points[i] / cell).array().floor());
    }
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(keys[a], a) < std::pair(keys[b], b);
    });
    for (std::uint32_t first = 0; first < order_.size();) {
        std::uint32_t end = first;
        while (end < order_.size() && keys[order_[end]] == keys[order_[first]]) ++end;
        cells_.emplace(keys[order_[first]], std::pair(first, end));
        first = end;
    }
}

std::size_t PointGrid::nearest(const Eigen::Vector3d& place) const {
    std::size_t best = points_.size();
    double least = cell_ * cell_;
    forNear(place, cell_, [&](std::uint32_t i, double d2) {
        if (d2 < least) {
            least = d2;
            best = i;
        }
    });
    return best;
}

}  // namespace dollytrack
