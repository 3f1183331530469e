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

/// A place that the camera's sphere can move about in.
struct FoundRoom {
    std::int64_t cells = 0;
    std::int64_t columns = 0;  // cells of its footprint
    std::array<int, 3> low = {0, 0, 0};
    std::array<int, 3> high = {0, 0, 0};      // inclusive
    std::array<int, 3> roomiest = {0, 0, 0};  // the cell farthest from all surfaces
};

/// The rooms of a map, largest first, and for every cell the number of its room or kNoRoom.
struct FoundRooms {
    std::vector<FoundRoom> rooms;
    std::vector<std::uint8_t> room_of_cell;
    // Cells where the sphere fits inside furniture, out of reach of any room: 1, else 0.
    std::vector<std::uint8_t> hollow;
};

/// Where the camera's sphere fits, and what tells it. References must outlive it.
struct FittingPlace {
    const RayCaster& rays;
    const VoxelGrid& grid;
    const std::vector<std::uint8_t>& surfaces;       // CellSurface sets
    const std::vector<std::uint16_t>& squared_gaps;  // see squaredGaps()
    const std::vector<std::uint8_t>& inside;         // see Enclosure
    double camera_radius_m = 0.0;
};

/// The cells inside in whose middle the sphere fits, by exact distance: 1, else 0.
std::vector<std::uint8_t> whereSphereFits(const FittingPlace& place, const JobContext& job);

/// The same from what fitted when things stood elsewhere: only cells in these boxes can be nearer
/// to what has moved than the sphere is large, now or then.
std::vector<std::uint8_t> whereSphereFitsAfter(const std::vector<std::uint8_t>& before,
                                               const std::vector<std::uint8_t>& inside_before,
                                               const std::vector<CellBox>& near_moved,
                                               const FittingPlace& place, const JobContext& job);

/// Finds the rooms: connected places where the sphere fits in the middle of every cell, and that
/// are rooms rather than the hollow of a piece of furniture.
FoundRooms findRooms(const Scene& scene, const RayCaster& rays, const VoxelGrid& grid,
                     const std::vector<std::uint8_t>& fits,
                     const std::vector<std::uint16_t>& squared_gaps);

}  // namespace dollytrack::planning
