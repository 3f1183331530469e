#pragma once

#include "engine/jobs/job.h"
#include "planning/free_space/cell_box.h"
#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Cut-off of distances, in cells; its square fits 15 bits.
constexpr int kMaxGapCells = 181;
constexpr std::uint16_t kMaxSquaredGap = kMaxGapCells * kMaxGapCells;

/// For every cell, the squared distance in cells between its cube and the cube of the nearest cell
/// with a surface, exact up to the cut-off. It is 0 in cells with a surface and in their 26
/// neighbours. Since a surface may lie anywhere in its cell and a point anywhere in its own, this
/// is the best lower bound of their distance that the grid gives. `surface` is nonzero where a cell
/// has a surface. On cancellation the result is incomplete.
std::vector<std::uint16_t> squaredGaps(const VoxelGrid& grid,
                                       const std::vector<std::uint8_t>& surface,
                                       const JobContext& job);

/// Incremental squaredGaps(): `before` is the result for surfaces that differ from `surfaces` only
/// in the boxes `changed`. Distances are recomputed only where a change may affect the nearest
/// surface.
std::vector<std::uint16_t> squaredGapsAfter(const std::vector<std::uint16_t>& before,
                                            const std::vector<CellBox>& changed,
                                            const VoxelGrid& grid,
                                            const std::vector<std::uint8_t>& surface,
                                            const JobContext& job);

}  // namespace dollytrack::planning
