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

struct FreeColumns;

/// A room: free space between walls and doorways, seen from above.
struct PlanRoom {
    std::string name;         // "room_1", "corridor_3": numbered by area, the largest first
    Eigen::AlignedBox3d box;  // of the camera positions in it, m
    double area_m2 = 0.0;     // footprint of those positions
    bool corridor = false;    // at most 1.8 m wide, and at least 2.5 times as long
    // Ends of its longer axis, at the height of the box's centre.
    Eigen::Vector3d near_end = Eigen::Vector3d::Zero();
    Eigen::Vector3d far_end = Eigen::Vector3d::Zero();
};

/// A narrow passage between two rooms through which the camera fits.
struct Doorway {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();    // centre of the positions where the camera
                                                         // fits
    Eigen::Vector3d through = Eigen::Vector3d::UnitX();  // horizontal unit vector from room_a into
                                                         // room_b
    double width_m = 0.0;                                // distance between the door posts
    int room_a = 0;
    int room_b = 0;
};

/// Rooms and doorways of a map. Parts of the floor plan are merged where one can walk between them
/// through more than a doorway: wider than 1.8 m, or 3 m under a lintel. All storeys are projected
/// onto one plan, and doorways are those of the lowest. Immutable.
class RoomPlan {
  public:
    RoomPlan(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
             double camera_radius_m);

    [[nodiscard]] const std::vector<PlanRoom>& rooms() const { return rooms_; }
    [[nodiscard]] const std::vector<Doorway>& doorways() const { return doorways_; }

    /// Index of the room at a position, by its column; above a wall, of the nearest room. 0 outside
    /// the map.
    [[nodiscard]] int roomAt(const Eigen::Vector3d& place) const;

    /// Whether a quadratic Bezier curve stays in the room it starts in, sampled every half column.
    /// If not, `where` is the first sample outside.
    [[nodiscard]] bool inOneRoom(const Eigen::Vector3d& start, const Eigen::Vector3d& control,
                                 const Eigen::Vector3d& end, Eigen::Vector3d& where) const;

  private:
    void takeRooms(const FreeColumns& free_columns, const std::vector<int>& parts,
                   const std::vector<int>& room_of_part);

    VoxelGrid plane_;  // one layer
    std::vector<int> room_of_column_;
    std::vector<PlanRoom> rooms_;
    std::vector<Doorway> doorways_;
};

}  // namespace dollytrack::planning
