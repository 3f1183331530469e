#include "engine/geometry/cloud_error.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

namespace dollytrack {
namespace {

using Cell = std::array<std::int64_t, 3>;

Cell cellOf(const Eigen::Vector3d& point, double size) {
    // Points farther out share the outermost cells, so that cell indices and their neighbours do
    // not overflow.
    constexpr double kOutermost = 1e15;
    const auto at = [&](double value) {
        return static_cast<std::int64_t>(
            std::clamp(std::floor(value / size), -kOutermost, kOutermost));
    };
    return {at(point.x()), at(point.y()), at(point.z())};
}

/// Points in a grid whose cells are as wide as the search radius, so that all points within it are
/// in the same or a neighbouring cell.
class PointGrid {
  public:
    PointGrid(std::span<const Eigen::Vector3d> points, double radius)
        : points_(points), radius_(radius) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            cells_[cellOf(points[i], radius)].push_back(i);
        }
    }

    [[nodiscard]] bool holdsNear(const Eigen::Vector3d& place) const {
        const Cell middle = cellOf(place, radius_);
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                for (std::int64_t dz = -1; dz <= 1; ++dz) {
                    const auto cell = cells_.find({middle[0] + dx, middle[1] + dy, middle[2] + dz});
                    if (cell != cells_.end() && isNear(cell->second, place)) return true;
                }
            }
        }
        return false;
    }

  private:
    [[nodiscard]] bool isNear(const std::vector<std::size_t>& some,
                              const Eigen::Vector3d& place) const {
        return std::any_of(some.begin(), some.end(),
                           [&](std::size_t i) { return (points_[i] - place).norm() <= radius_; });
    }

    std::span<const Eigen::Vector3d> points_;
    double radius_;
    std::map<Cell, std::vector<std::size_t>> cells_;
};

}  // namespace

CloudError cloudError(std::span<const Eigen::Vector3d> cloud, const RayCaster& rays) {
    CloudError error;
    error.points = static_cast<int>(cloud.size());
    if (cloud.empty()) return error;
    std::vector<double> distances(cloud.size());
    parallelRanges(cloud.size(), 1000, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) distances[i] = rays.closest(cloud[i]).distance;
    });
    const auto count = static_cast<double>(distances.size());
    error.mean_m = std::accumulate(distances.begin(), distances.end(), 0.0) / count;
    std::sort(distances.begin(), distances.end());
    const auto at = [&](double share) {
        const auto i = static_cast<std::size_t>(std::ceil(share * count)) - 1;
        return distances[std::min(i, distances.size() - 1)];
    };
    error.median_m = at(0.5);
    error.p90_m = at(0.9);
    error.p95_m = at(0.95);
    return error;
}

double coveredShare(std::span<const Eigen::Vector3d> surface,
                    std::span<const Eigen::Vector3d> cloud, double radius_m) {
    if (surface.empty()) return 0.0;
    const PointGrid grid(cloud, radius_m);
    std::vector<char> covered(surface.size());
    parallelRanges(surface.size(), 1000, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) covered[i] = grid.holdsNear(surface[i]) ? 1 : 0;
    });
    return static_cast<double>(std::count(covered.begin(), covered.end(), 1)) /
           static_cast<double>(surface.size());
}

}  // namespace dollytrack
