#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dollytrack {

/// A grid of points for neighbour queries. The points must outlive it and must be within a million
/// cells of the origin.
class PointGrid {
  public:
    PointGrid(std::span<const Eigen::Vector3d> points, double cell);

    /// Calls `visit(index, squared distance)` for every point within `radius`, which must not
    /// exceed the cell size, in a deterministic order.
    template <class Visit>
    void forNear(const Eigen::Vector3d& place, double radius, Visit&& visit) const {
        const Eigen::Array3d middle = (place / cell_).array().floor();
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dz = -1; dz <= 1; ++dz) {
                    const auto found = cells_.find(keyOf(middle + Eigen::Array3d(dx, dy, dz)));
                    if (found == cells_.end()) continue;
                    for (std::uint32_t i = found->second.first; i < found->second.second; ++i) {
                        const double d2 = (points_[order_[i]] - place).squaredNorm();
                        if (d2 <= radius * radius) visit(order_[i], d2);
                    }
                }
            }
        }
    }

    /// Index of the nearest point within the cell size; the number of points if there is none.
    [[nodiscard]] std::size_t nearest(const Eigen::Vector3d& place) const;

    static std::uint64_t keyOf(const Eigen::Array3d& cell) {
        const auto part = [](double value) {
            return (static_cast<std::uint64_t>(static_cast<std::int64_t>(value) + 1'048'576)) &
                   0x1FFFFFU;
        };
        return part(cell.x()) << 42U | part(cell.y()) << 21U | part(cell.z());
    }

  private:
    std::span<const Eigen::Vector3d> points_;
    double cell_;
    std::vector<std::uint32_t> order_;
    std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> cells_;
};

}  // namespace dollytrack
