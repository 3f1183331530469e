#pragma once

#include "planning/free_space/voxel_grid.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// A block of grid cells, [begin, end) along each axis, never outside the grid.
struct CellBox {
    std::array<int, 3> begin = {0, 0, 0};
    std::array<int, 3> end = {0, 0, 0};
    bool operator==(const CellBox&) const = default;

    [[nodiscard]] bool empty() const {
        return begin[0] >= end[0] || begin[1] >= end[1] || begin[2] >= end[2];
    }
    [[nodiscard]] int size(unsigned axis) const { return end[axis] - begin[axis]; }
    [[nodiscard]] bool contains(int x, int y, int z) const {
        return x >= begin[0] && x < end[0] && y >= begin[1] && y < end[1] && z >= begin[2] &&
               z < end[2];
    }
};

/// Whether the two boxes share a cell.
bool overlap(const CellBox& a, const CellBox& b);

/// The box of all cells of the grid.
CellBox wholeGrid(const VoxelGrid& grid);

/// The cells that a box touches, with one more cell on each side, clipped to the grid.
/// `box_in_cells` is in units of cells, relative to the grid's first corner, and may be of any
/// size.
CellBox cellsAround(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_in_cells);

/// The box enlarged by `cells` on each side, clipped to the grid. An empty box stays empty.
CellBox grown(const CellBox& box, int cells, const VoxelGrid& grid);

/// Calls visit(begin, end, x, y, z) for each row of the box: [begin, end) are indices into the
/// grid's arrays, (x, y, z) is the first cell.
template <class Visit>
void visitRows(const CellBox& box, const VoxelGrid& grid, Visit&& visit) {
    if (box.empty()) return;
    for (int z = box.begin[2]; z < box.end[2]; ++z) {
        for (int y = box.begin[1]; y < box.end[1]; ++y) {
            const std::size_t begin = grid.indexOf(box.begin[0], y, z);
            visit(begin, begin + static_cast<std::size_t>(box.size(0)), box.begin[0], y, z);
        }
    }
}

/// Disjoint boxes that cover exactly the cells covered by `boxes`.
std::vector<CellBox> apart(const std::vector<CellBox>& boxes);

/// The smallest box around the cells of `box` whose values differ between `a` and `b`; empty if
/// none do. `a` and `b` hold one value per grid cell.
CellBox changedIn(const CellBox& box, const VoxelGrid& grid, const std::vector<std::uint8_t>& a,
                  const std::vector<std::uint8_t>& b);

/// Boxes around all cells whose values differ between `a` and `b`: one within each box of `likely`
/// that has differences, and one around all other differences.
std::vector<CellBox> changedBoxes(const std::vector<CellBox>& likely, const VoxelGrid& grid,
                                  const std::vector<std::uint8_t>& a,
                                  const std::vector<std::uint8_t>& b);

}  // namespace dollytrack::planning
