#pragma once

#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/cell_box.h"
#include "planning/free_space/voxel_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Properties of the surfaces in a cell, as bits. A cell without surface is 0.
enum CellSurface : std::uint8_t {
    kSurface = 1,    // a triangle touches the cell
    kBuilding = 2,   // of an object that does not extend far outside the room, as ground planes and
                     // skies do
    kStructure = 4,  // of a wall, floor or ceiling, or of an object that spans the room
    kSteep = 8,      // more upright than horizontal
};

/// Extent of the surfaces of one object.
struct SurfaceReach {
    Eigen::AlignedBox3d box_in_cells;  // around its triangles, in cells from the grid's first
                                       // corner
    // As SurfaceCells::gap_beyond_m, for this object alone.
    std::array<double, 6> gap_beyond_m = {};
};

/// The cells of a grid that contain surfaces, and how far the surfaces reach beyond it.
struct SurfaceCells {
    std::vector<std::uint8_t> cells;  // CellSurface bits, by cell
    // For each side of the grid (-x, +x, -y, +y, -z, +z), the distance from the side to the nearest
    // surface outside it, m; 0 if a surface crosses the side, infinity if there is none.
    std::array<double, 6> gap_beyond_m = {};
    std::vector<SurfaceReach> reach;  // by object, in the scene's order
};

/// Marks every cell that a triangle overlaps or touches, without gaps: a surface on the border of
/// two cells is in both. Triangles with NaN or infinite corners are skipped. On cancellation the
/// result is incomplete.
SurfaceCells voxelize(const Scene& scene, const VoxelGrid& grid, const JobContext& job);

/// Incremental voxelize(): `before` is the result for a scene in which only the objects `moved`
/// (ids, ascending) differ in pose. Sets `changed` to boxes around the cells that differ.
SurfaceCells voxelizeMoved(const SurfaceCells& before, const Scene& scene, const VoxelGrid& grid,
                           const std::vector<int>& moved, std::vector<CellBox>& changed,
                           const JobContext& job);

}  // namespace dollytrack::planning
