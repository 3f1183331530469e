#pragma once

#include "engine/jobs/job.h"
#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// How much a place must be surrounded to count as inside the building.
enum class EnclosureRule {
    Walls,      // walls nearly all round, or half round between floor and ceiling
    FewWalls,   // half round, or less over a floor of its own: doll's houses, cut-away rooms
    FloorOnly,  // anything above a floor
};

/// Marks the cells without surface that are inside the building: 1 inside, 0 not.
///
/// Three things are asked of every cell: in how many of 16 horizontal directions it meets
/// something of the building within the grid, and whether there is something of the building below
/// and above it. A ground plane is not of the building. Cells that pass are certain; cells that
/// pass weakly (before a missing wall, at a window without glass, but also in the notch of an
/// L-shaped house) take the vote of the wide space they are in, where space is cut at doors.
std::vector<std::uint8_t> findInside(const VoxelGrid& grid,
                                     const std::vector<std::uint8_t>& surfaces,
                                     const std::vector<std::uint16_t>& squared_gaps,
                                     EnclosureRule rule, const JobContext& job);

}  // namespace dollytrack::planning
