#pragma once

#include "engine/scene/scene.h"
#include "planning/free_space/free_space.h"
#include "planning/free_space/voxel_grid.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

struct AirColumns;

/// A room as people count them: air between walls, cut off at its doorways.
struct PlanRoom {
    std::string name;         // "room_1", the largest first; "corridor_3" where it is one
    Eigen::AlignedBox3d box;  // of the camera's places in it, m
    double area_m2 = 0.0;     // of their footprint
    bool corridor = false;    // long and narrow
    // Ends of its longer middle line, for a corridor; at the height of the box's middle.
    Eigen::Vector3d near_end = Eigen::Vector3d::Zero();
    Eigen::Vector3d far_end = Eigen::Vector3d::Zero();
};

/// A narrow place between two rooms that the camera fits through.
struct Doorway {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();    // in the middle of where it fits
    Eigen::Vector3d through = Eigen::Vector3d::UnitX();  // level, unit, from room_a into room_b
    double width_m = 0.0;                                // between the door's posts
    int room_a = 0;
    int room_b = 0;
};

/// The rooms and doorways of a map. The floor plan is cut where it is narrow; rooms are joined
/// again where one can walk from one into the other through more than a doorway: 1.8 m, or 3 m
/// under a lintel. All storeys are seen from above together, as the floor plan sees them, and
/// doorways are those of the lowest. Const.
class RoomPlan {
  public:
    RoomPlan(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
             double camera_radius_m);

    [[nodiscard]] const std::vector<PlanRoom>& rooms() const { return rooms_; }
    [[nodiscard]] const std::vector<Doorway>& doorways() const { return doorways_; }

    /// The room of a place, or the nearest one's where it is over a wall; 0 outside the map.
    [[nodiscard]] int roomAt(const Eigen::Vector3d& place) const;

    /// Whether a quadratic Bezier curve stays in the room it begins in, looked at in steps of half
    /// a column; `where` is the first place beyond.
    [[nodiscard]] bool inOneRoom(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                 const Eigen::Vector3d& end, Eigen::Vector3d& where) const;

  private:
    void takeRooms(const AirColumns& air, const std::vector<int>& parts,
                   const std::vector<int>& room_of_part);

    VoxelGrid plane_;  // one layer
    std::vector<int> room_of_column_;
    std::vector<PlanRoom> rooms_;
    std::vector<Doorway> doorways_;
};

}  // namespace dollytrack::planning
