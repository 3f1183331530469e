#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "planning/free_space/cell_box.h"
#include "planning/free_space/voxel_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::planning {

constexpr std::uint8_t kNoRoom = 255;

/// A connected region where the camera sphere fits. Cell coordinates are in the grid.
struct FoundRoom {
    std::int64_t cells = 0;
    std::int64_t columns = 0;  // of its footprint
    std::array<int, 3> low = {0, 0, 0};
    std::array<int, 3> high = {0, 0, 0};      // inclusive
    std::array<int, 3> roomiest = {0, 0, 0};  // the cell farthest from all surfaces
};

/// The rooms of a map, largest first, and by cell the index of its room or kNoRoom.
struct FoundRooms {
    std::vector<FoundRoom> rooms;
    std::vector<std::uint8_t> room_of_cell;
    // By cell: 1 where the sphere fits inside furniture, unreachable from any room; else 0.
    std::vector<std::uint8_t> hollow;
};

/// Input of the search for cells where the camera sphere fits. Keeps references.
struct SphereFitInput {
    const RayCaster& rays;
    const VoxelGrid& grid;
    const std::vector<std::uint8_t>& surfaces;       // CellSurface bits, by cell
    const std::vector<std::uint16_t>& squared_gaps;  // see squaredGaps()
    const std::vector<std::uint8_t>& inside;         // see Enclosure
    double camera_radius_m = 0.0;
};

/// By cell: 1 if it is inside and the sphere fits at its centre, by exact distance; else 0. On
/// cancellation the result is incomplete.
std::vector<std::uint8_t> whereSphereFits(const SphereFitInput& input, const JobContext& job);

/// Incremental whereSphereFits(): `before` and `inside_before` are from before objects moved; the
/// disjoint boxes `near_moved` hold all cells within a camera radius of a moved object, before or
/// after.
std::vector<std::uint8_t> whereSphereFitsAfter(const std::vector<std::uint8_t>& before,
                                               const std::vector<std::uint8_t>& inside_before,
                                               const std::vector<CellBox>& near_moved,
                                               const SphereFitInput& input, const JobContext& job);

/// Finds the rooms among the connected components of `fits`: components of sufficient volume,
/// height and clearance that do not lie inside a piece of furniture; at most 250. If there is none,
/// the largest component is a room if it has at least 0.05 m3 and is not inside furniture. May find
/// no room.
FoundRooms findRooms(const Scene& scene, const RayCaster& rays, const VoxelGrid& grid,
                     const std::vector<std::uint8_t>& fits,
                     const std::vector<std::uint16_t>& squared_gaps);

}  // namespace dollytrack::planning
