#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
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

/// Finds the rooms among the cells marked inside: connected places where the sphere fits in the
/// middle of every cell, by exact distance, and that are rooms rather than the hollow of a piece
/// of furniture.
FoundRooms findRooms(const Scene& scene, const RayCaster& rays, const VoxelGrid& grid,
                     const std::vector<std::uint8_t>& surfaces,
                     const std::vector<std::uint16_t>& squared_gaps,
                     const std::vector<std::uint8_t>& inside, double camera_radius_m,
                     const JobContext& job);

}  // namespace dollytrack::planning
