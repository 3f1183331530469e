#pragma once

#include "engine/jobs/job.h"
#include "planning/free_space/floor_plan.h"
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
/// By what is seen from it (lookAround) a cell may be inside for certain, or perhaps: before a
/// missing wall, at a window without glass, but also in the notch of an L-shaped house. The cells
/// vote in the parts of the floor plan, height by height, so that a room is inside as a whole. A
/// part full of furniture is inside even where it has few walls.
std::vector<std::uint8_t> findInside(const VoxelGrid& grid,
                                     const std::vector<std::uint8_t>& surfaces,
                                     const std::vector<std::uint8_t>& sight, const FloorPlan& plan,
                                     EnclosureRule rule);

}  // namespace dollytrack::planning
