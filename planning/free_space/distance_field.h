#pragma once

#include "engine/jobs/job.h"
#include "planning/free_space/cell_box.h"
#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Distances are cut off at this many cells, so that their squares fit 15 bits.
constexpr int kMaxGapCells = 181;
constexpr std::uint16_t kMaxSquaredGap = kMaxGapCells * kMaxGapCells;

/// For every cell the squared gap, in cells, between it and the nearest cell with a surface: the
/// distance between the two cubes, exact up to the cut-off. Since a surface lies somewhere in
/// its cell and a point somewhere in its own, the gap is the best lower bound of the distance
/// between the two that cells can give: 0 in a cell with a surface and in its 26 neighbours.
std::vector<std::uint16_t> squaredGaps(const VoxelGrid& grid,
                                       const std::vector<std::uint8_t>& surface,
                                       const JobContext& job);

/// The same from the gaps of other surfaces that differ in these boxes only: gaps are made anew
/// where a change may be nearer than the surface that was nearest.
std::vector<std::uint16_t> squaredGapsAfter(const std::vector<std::uint16_t>& before,
                                            const std::vector<CellBox>& changed,
                                            const VoxelGrid& grid,
                                            const std::vector<std::uint8_t>& surface,
                                            const JobContext& job);

}  // namespace dollytrack::planning
