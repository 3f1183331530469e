#pragma once

#include "planning/free_space/voxel_grid.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// A block of cells of a grid, [begin, end) along each axis, and never outside the grid.
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

/// Whether the two share cells.
bool overlap(const CellBox& a, const CellBox& b);

/// All cells.
CellBox wholeGrid(const VoxelGrid& grid);

/// The cells that a box touches or that are next to it; the box is in units of cells, from the
/// grid's first corner, and may be of any size.
CellBox cellsAround(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_in_cells);

/// With so many more cells on each side, as far as the grid goes.
CellBox grown(const CellBox& box, int cells, const VoxelGrid& grid);

/// Calls visit(begin, end, x, y, z) for each row of the box, with the cells' indices in the grid.
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

/// Boxes that share no cell and hold all cells of these, but no others.
std::vector<CellBox> apart(const std::vector<CellBox>& boxes);

/// The smallest box around the cells of this one that differ.
CellBox changedIn(const CellBox& box, const VoxelGrid& grid, const std::vector<std::uint8_t>& a,
                  const std::vector<std::uint8_t>& b);

/// Boxes around all cells that differ: one in each of those where it is likely, and one around all
/// others.
std::vector<CellBox> changedBoxes(const std::vector<CellBox>& likely, const VoxelGrid& grid,
                                  const std::vector<std::uint8_t>& a,
                                  const std::vector<std::uint8_t>& b);

}  // namespace dollytrack::planning
