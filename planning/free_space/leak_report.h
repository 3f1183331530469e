#pragma once

#include "planning/free_space/rooms.h"
#include "planning/free_space/voxel_grid.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::planning {

enum class OpeningKind {
    NoCeiling,    // most of the room is open upwards
    NoFloor,      // most of the room is open downwards
    MissingWall,  // most of one side is open
    Hole,         // a window without glass, a door to the outside, a gap
};

/// Where a room's air ends without a surface.
struct Opening {
    OpeningKind kind = OpeningKind::Hole;
    int component = 0;                                          // the room, index into rooms()
    Eigen::Vector3d outwards = Eigen::Vector3d::UnitZ();        // one of the six axis directions
    Eigen::Vector3d center_in_world = Eigen::Vector3d::Zero();  // m
    double area_m2 = 0.0;
    bool at_scene_box = false;  // ends at the scene's box; else at the edge of the building
};

/// What is open in a scene. The openings are ordered by room, then by area.
struct LeakReport {
    std::vector<Opening> openings;

    [[nodiscard]] bool isClosed() const { return openings.empty(); }
};

/// One sentence: "Room 1 has no ceiling (12.0 m2, bounded by the scene's box)".
std::string describe(const Opening& opening);

/// Finds the openings from the free cells (value 1 in `free`), each counted for the nearest room.
LeakReport findLeaks(const VoxelGrid& grid, const std::vector<std::uint8_t>& states,
                     const FoundRooms& rooms);

}  // namespace dollytrack::planning
