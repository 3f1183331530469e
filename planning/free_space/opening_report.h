#pragma once

#include "planning/free_space/rooms.h"
#include "planning/free_space/voxel_grid.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::planning {

enum class OpeningKind {
    NoCeiling,    // at least half of the footprint is open upwards
    NoFloor,      // at least half of the footprint is open downwards
    MissingWall,  // at least half of one side is open
    Hole,         // a window without glass, a door to the outside, a gap
};

/// An area where a room's air ends without a surface.
struct Opening {
    OpeningKind kind = OpeningKind::Hole;
    int component = 0;                                    // the room: index into rooms()
    Eigen::Vector3d outwards = Eigen::Vector3d::UnitZ();  // one of the six axis directions
    // mean of the cells at the opening, m
    Eigen::Vector3d center_in_world = Eigen::Vector3d::Zero();
    double area_m2 = 0.0;
    bool at_scene_box = false;  // at the scene's bounding box; else at the edge of the building
};

/// The openings of a scene, sorted by room, then by area, the largest first.
struct OpeningReport {
    std::vector<Opening> openings;

    [[nodiscard]] bool isClosed() const { return openings.empty(); }
};

/// One phrase: "Room 1 has no ceiling (12.0 m2 around 1.0, 2.0, 2.4; at the edge of the scene)".
std::string describe(const Opening& opening);

/// Finds the openings of at least 0.1 m2 from the cell states. Each belongs to the room found
/// within 12 cells inwards; openings without a room are dropped.
OpeningReport findOpenings(const VoxelGrid& grid, const std::vector<std::uint8_t>& states,
                           const FoundRooms& rooms);

}  // namespace dollytrack::planning
