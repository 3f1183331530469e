#pragma once

#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

constexpr int kNoPart = -1;

/// The map seen from above, cut into parts at its walls and at what is narrow between them: doors,
/// windows, gaps. A part is a room, a corridor, the garden; a large or crooked room may be several.
struct FloorPlan {
    int parts = 0;
    std::vector<int> part_of_column;  // x first, then y; kNoPart in walls
    bool operator==(const FloorPlan&) const = default;
};

/// Walls are columns that hold an upright surface of structure of at least 0.6 m, or any upright
/// surface of at least 1.5 m. All heights count together, so a plan of several floors is cut more
/// often than need be.
FloorPlan drawFloorPlan(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces);

}  // namespace dollytrack::planning
