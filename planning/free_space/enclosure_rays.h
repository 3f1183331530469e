#pragma once

#include "engine/jobs/job.h"
#include "planning/free_space/cell_box.h"
#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

constexpr int kEnclosureDirections = 16;
constexpr std::uint8_t kEnclosureHitsMask = 31;
constexpr std::uint8_t kFloorBelow = 32;
constexpr std::uint8_t kCeilingAbove = 64;

/// Surroundings of every cell, as bits: the number of 16 horizontal directions in which a wall is
/// met within the grid (kEnclosureHitsMask), and whether a surface of the building lies vertically
/// below (kFloorBelow) and above (kCeilingAbove). Ground planes do not belong to the building.
/// Walls are upright structure, or any upright surface if the scene marks almost no structure.
std::vector<std::uint8_t> castEnclosureRays(const VoxelGrid& grid,
                                            const std::vector<std::uint8_t>& surfaces,
                                            const JobContext& job);

/// Incremental castEnclosureRays(): `before` is the result for `surfaces_before`, which differs
/// from `surfaces` only in the boxes `changed`. On return `changed` holds disjoint boxes around all
/// recomputed cells: the columns through the boxes, and the whole slices where walls differ.
std::vector<std::uint8_t> updateEnclosureRays(const std::vector<std::uint8_t>& before,
                                              const std::vector<std::uint8_t>& surfaces_before,
                                              const VoxelGrid& grid,
                                              const std::vector<std::uint8_t>& surfaces,
                                              std::vector<CellBox>& changed, const JobContext& job);

}  // namespace dollytrack::planning
