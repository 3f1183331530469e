#pragma once

#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Cells [x_begin, x_end) of one row that belong to the same component.
struct CellRun {
    int x_begin = 0;
    int x_end = 0;
    int y = 0;
    int z = 0;
    int component = 0;
};

/// Connected components of a set of cells; cells that share a face are connected.
struct CellComponents {
    std::vector<CellRun> runs;        // sorted by z, y, x
    std::vector<std::int64_t> cells;  // number of cells, by component
};

/// Labels the components of the cells whose value has any of the bits in `mask`. Components are
/// numbered in the order of their first cell.
CellComponents findComponents(const VoxelGrid& grid, const std::vector<std::uint8_t>& cells,
                              std::uint8_t mask);

}  // namespace dollytrack::planning
