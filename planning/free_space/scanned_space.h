#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "planning/free_space/voxel_grid.h"
#include "planning/visibility/scanned_surfaces.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Which cells without surface lie in the part of a scan that was scanned: 1, else 0. Such a cell
/// sees the front of scanned surface in a good part of all directions; behind a wall it sees backs,
/// and beyond the scan's edge next to nothing. What counts as a good part is measured in the scan
/// itself: half of what its best places see. Asked once a block of cells.
std::vector<std::uint8_t> findScannedSpace(const VoxelGrid& grid,
                                           const std::vector<std::uint8_t>& surfaces,
                                           const ScannedSurfaces& scan, const RayCaster& rays,
                                           const JobContext& job);

}  // namespace dollytrack::planning
