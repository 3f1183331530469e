#pragma once

#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/cell_box.h"
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

/// How far the surfaces of one object reach.
struct SurfaceReach {
    Eigen::AlignedBox3d box_in_cells;  // around its triangles, from the grid's first corner
    // As that of all surfaces below.
    std::array<double, 6> gap_beyond_m = {};
};

/// The surfaces of a scene in a grid.
struct SurfaceCells {
    std::vector<std::uint8_t> cells;  // one CellSurface set a cell
    // How far beyond each side of the grid (-x, +x, -y, +y, -z, +z) the nearest surface is that
    // lies beyond it; 0 where one crosses the side; infinite where there is none. In metres.
    std::array<double, 6> gap_beyond_m = {};
    std::vector<SurfaceReach> reach;  // of the objects, in their order
};

/// Every cell that a triangle overlaps or touches, exactly: closed cells, so a surface on the
/// border of two cells is in both, and no ray slips through. Triangles with NaN are left out.
SurfaceCells voxelize(const Scene& scene, const VoxelGrid& grid, const JobContext& job);

/// The same, from that of a scene of which only these objects (ids, rising) stood elsewhere. Only
/// the cells where they were and are get marked anew; they are left in `changed`.
SurfaceCells voxelizeMoved(const SurfaceCells& before, const Scene& scene, const VoxelGrid& grid,
                           const std::vector<int>& moved, std::vector<CellBox>& changed,
                           const JobContext& job);

}  // namespace dollytrack::planning
