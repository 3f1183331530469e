#pragma once

#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

constexpr int kNoPart = -1;

/// Floor plan: the columns of the map, segmented into parts at walls and at narrow openings (doors,
/// windows, gaps). A part is a room, a corridor or the garden; a large or irregular room may be
/// several parts.
struct FloorPlan {
    int parts = 0;
    std::vector<int> part_of_column;  // x first, then y; kNoPart in walls
    bool operator==(const FloorPlan&) const = default;
};

/// Segments the map seen from above. Walls are columns that hold at least 0.6 m of upright
/// structure, or at least 1.5 m of any upright surface. All heights count together, so a building
/// with several storeys may be cut more often than necessary.
FloorPlan drawFloorPlan(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces);

}  // namespace dollytrack::planning
