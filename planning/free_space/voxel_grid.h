#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace dollytrack::planning {

/// A block of cubic cells, aligned with the cells of an OctoMap tree of the same resolution: cell i
/// of axis k covers [first[k] + i, first[k] + i + 1) * resolution_m. Cells are stored x first, then
/// y, then z.
struct VoxelGrid {
    double resolution_m = 0.05;
    std::array<int, 3> first = {0, 0, 0};
    std::array<int, 3> count = {0, 0, 0};
    // Cells whose centre lies in the room bounds. The rim around them only holds surfaces.
    std::array<int, 3> room_begin = {0, 0, 0};
    std::array<int, 3> room_end = {0, 0, 0};
    bool operator==(const VoxelGrid&) const = default;

    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
               static_cast<std::size_t>(count[2]);
    }
    [[nodiscard]] std::size_t rowOf(int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count[1]) +
                static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(count[0]);
    }
    [[nodiscard]] std::size_t indexOf(int x, int y, int z) const {
        return rowOf(y, z) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] Eigen::Vector3d centerOf(int x, int y, int z) const {
        return resolution_m *
               Eigen::Vector3d(first[0] + x + 0.5, first[1] + y + 0.5, first[2] + z + 0.5);
    }
    /// Sets `cell` to the cell that contains a point. Returns false if the point is outside the
    /// grid or not a number.
    [[nodiscard]] bool find(const Eigen::Vector3d& point, std::array<int, 3>& cell) const {
        for (int k = 0; k < 3; ++k) {
            const double at = std::floor(point[k] / resolution_m) - first[static_cast<unsigned>(k)];
            if (!(at >= 0.0 && at < count[static_cast<unsigned>(k)])) return false;
            cell[static_cast<unsigned>(k)] = static_cast<int>(at);
        }
        return true;
    }
    [[nodiscard]] bool inRoom(int x, int y, int z) const {
        return x >= room_begin[0] && x < room_end[0] && y >= room_begin[1] && y < room_end[1] &&
               z >= room_begin[2] && z < room_end[2];
    }
    [[nodiscard]] Eigen::AlignedBox3d box() const {
        const Eigen::Vector3d low(first[0], first[1], first[2]);
        const Eigen::Vector3d high = low + Eigen::Vector3d(count[0], count[1], count[2]);
        return {low * resolution_m, high * resolution_m};
    }
};

/// The grid around `bounds`, with a rim of one cell. `resolution_m` is enlarged if the grid would
/// have more than `max_cells`.
VoxelGrid makeVoxelGrid(const Eigen::AlignedBox3d& bounds, double resolution_m,
                        std::size_t max_cells);

}  // namespace dollytrack::planning
