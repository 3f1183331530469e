#pragma once

#include "engine/document/edits.h"
#include "engine/geometry/ray_caster.h"
#include "planning/plan_params.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace dollytrack::planning {

class FloorHeights;
class FreeSpace;

/// The free distance around the camera's body.
struct BodyGap {
    double free_m = std::numeric_limits<double>::infinity();  // from its side; capped
    int object_id = 0;  // what is nearest; 0: a no-go box, or the edge of a step down
};

/// The levels of the floor on which a camera of exact height drives, and what its body may meet
/// there. A level is a height of the floor; all floor within max_step_m of it belongs to it, and
/// the camera keeps one height above it. Each level has a plan, exact: every triangle between the
/// cylinder's bottom and its top, cut off there and seen from above. The cylinder is free where the
/// nearest of them is farther than its radius. Edges where the floor ends or steps down are
/// obstacles, too. Of the places that the body can reach from one another, only the largest part in
/// each component of free space and level counts. Const, many threads.
class FloorLevels {
  public:
    FloorLevels(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                const FloorHeights& floors, const std::vector<NoGoBox>& no_go,
                const BodyParams& body, double camera_radius_m);

    /// The place, moved up or down to the camera's height above the level of the floor below it.
    [[nodiscard]] Eigen::Vector3d onLevel(const Eigen::Vector3d& place) const;

    /// Whether the place is at the camera's height above a level.
    [[nodiscard]] bool isOnLevel(const Eigen::Vector3d& place) const { return levelAt(place) >= 0; }

    /// Whether the body can come there from most other places of its level. Only for places on one.
    [[nodiscard]] bool isReached(const Eigen::Vector3d& place) const;

    /// Around the body with the camera at the place, exact up to a cap of 0.25 m; 0 off the levels.
    [[nodiscard]] BodyGap gap(const Eigen::Vector3d& place) const;

    /// Where the camera can be, by component of free space, in a fixed order.
    [[nodiscard]] const std::vector<std::vector<Eigen::Vector3f>>& cells() const { return cells_; }

    /// Heights of the levels in the world, m, largest area first.
    [[nodiscard]] std::vector<double> heights() const;

  private:
    struct Level {
        double floor_m = 0.0;
        std::vector<char> floor;      // columns whose floor belongs to it
        std::vector<char> reached;    // columns where the body can come
        std::vector<int> object_ids;  // of the plan's objects, by their index; 0: none
        RayCaster plan;
    };

    [[nodiscard]] int levelAt(const Eigen::Vector3d& place) const;
    [[nodiscard]] Eigen::Vector3d placeOver(std::size_t column, double height) const;
    [[nodiscard]] int columnOf(const Eigen::Vector3d& place) const;  // -1: beside the map
    [[nodiscard]] std::vector<double> findHeights(const FreeSpace& free_space,
                                                  const FloorHeights& floors) const;
    [[nodiscard]] std::vector<char> floorOf(double height, const FloorHeights& floors) const;
    [[nodiscard]] Level makeLevel(const Scene& scene, const FloorHeights& floors,
                                  const std::vector<NoGoBox>& no_go, double height) const;
    void reach(Level& level, const RayCaster& rays, const FreeSpace& free_space,
               const std::vector<NoGoBox>& no_go, double camera_radius_m);

    BodyParams body_;
    double radius_m_;  // of the cylinder; 0 without one
    Eigen::Vector2d origin_;
    double cell_m_;
    int columns_x_;
    int columns_y_;
    std::vector<Level> levels_;
    std::vector<std::vector<Eigen::Vector3f>> cells_;
};

}  // namespace dollytrack::planning
