#pragma once

#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/voxel_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// What the surfaces in a cell are, as bits. A cell without surface is 0.
enum CellSurface : std::uint8_t {
    kSurface = 1,    // a triangle touches the cell
    kBuilding = 2,   // of something other than a ground or sky that goes on outside the room
    kStructure = 4,  // of a wall, floor or ceiling rather than of a thing in the room
    kSteep = 8,      // nearer to upright than to level
};

/// The surfaces of a scene in a grid.
struct SurfaceCells {
    std::vector<std::uint8_t> cells;  // one CellSurface set a cell
    // How far beyond each side of the grid (-x, +x, -y, +y, -z, +z) the nearest surface is that
    // lies beyond it; 0 where one crosses the side; infinite where there is none. In metres.
    std::array<double, 6> gap_beyond_m = {};
};

/// Every cell that a triangle overlaps or touches, exactly: closed cells, so a surface on the
/// border of two cells is in both, and no ray slips through. Triangles with NaN are left out.
SurfaceCells voxelize(const Scene& scene, const VoxelGrid& grid, const JobContext& job);

}  // namespace dollytrack::planning
