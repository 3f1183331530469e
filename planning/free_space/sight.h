#pragma once

#include "engine/jobs/job.h"
#include "planning/free_space/cell_box.h"
#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

constexpr int kSightDirections = 16;
constexpr std::uint8_t kSightHitsMask = 31;
constexpr std::uint8_t kFloorBelow = 32;
constexpr std::uint8_t kCeilingAbove = 64;

/// What is seen of the building from every cell: in how many of 16 horizontal directions a wall
/// of it stands within the grid (the low five bits), and whether something of it is straight below
/// (kFloorBelow) and above (kCeilingAbove). A ground plane is not of the building; walls are its
/// structure, or everything where the scene does not say what is structure.
std::vector<std::uint8_t> lookAround(const VoxelGrid& grid,
                                     const std::vector<std::uint8_t>& surfaces,
                                     const JobContext& job);

/// The same from what was seen among other surfaces that differ in these boxes only. `changed` is
/// then what was looked at anew: the columns through the boxes, and where walls differ the slices.
std::vector<std::uint8_t> lookAroundAfter(const std::vector<std::uint8_t>& before,
                                          const std::vector<std::uint8_t>& surfaces_before,
                                          const VoxelGrid& grid,
                                          const std::vector<std::uint8_t>& surfaces,
                                          std::vector<CellBox>& changed, const JobContext& job);

}  // namespace dollytrack::planning
