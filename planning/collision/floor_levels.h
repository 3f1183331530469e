#pragma once

#include "engine/document/edits.h"
#include "engine/geometry/ray_caster.h"
#include "planning/free_space/floor_heights.h"
#include "planning/plan_params.h"

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace dollytrack::planning {

class FreeSpace;

/// Free distance around the camera's body.
struct BodyClearance {
    double free_m = std::numeric_limits<double>::infinity();  // from the cylinder's side, m; capped
    int object_id = 0;  // nearest object; 0: a no-go box, a floor edge or none
};

/// Floor levels for a camera with an exact height, and collision tests for its cylinder body. A
/// level is one floor height; floor within max_step_m of it belongs to the level. The camera keeps
/// a constant height above the level. Obstacles of a level are all triangles between the cylinder's
/// bottom and top, projected to the floor (see FlatObstacles), no-go boxes, and edges where the
/// floor ends or steps down. The body is free where the nearest obstacle is farther than its
/// radius. Only the largest area in which the body can drive counts, per level and component of
/// free space. Immutable; safe to call from many threads.
class FloorLevels {
  public:
    FloorLevels(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                const FloorHeights& floors, const std::vector<NoGoBox>& no_go,
                const BodyParams& body, double camera_radius_m);

    /// The position moved vertically to the camera's height above a level: one with floor at this
    /// column is preferred, then the highest one below, then the lowest one above. Returns it
    /// unchanged without levels.
    [[nodiscard]] Eigen::Vector3d onLevel(const Eigen::Vector3d& place) const;

    /// Whether the position is at the camera's height above some level, to 0.01 mm.
    [[nodiscard]] bool isOnLevel(const Eigen::Vector3d& place) const { return levelAt(place) >= 0; }

    /// Whether the body can drive to the position within its level, judged on the grid: the
    /// position's column or a neighbour must be in the connected area. False off the levels.
    [[nodiscard]] bool isReached(const Eigen::Vector3d& place) const;

    /// Free distance around the body with the camera at the position, exact up to a cap of 0.25 m;
    /// negative on overlap, 0 off the levels.
    [[nodiscard]] BodyClearance clearance(const Eigen::Vector3d& place) const;

    /// Centres of the cells where the camera can be, by component of free space, in a fixed order.
    [[nodiscard]] const std::vector<std::vector<Eigen::Vector3f>>& cells() const { return cells_; }

    /// Heights of the levels, z in the world, m, the level with the largest area first.
    [[nodiscard]] std::vector<double> heights() const;

  private:
    struct Level {
        double floor_m = 0.0;
        std::vector<char> floor;      // by column: 1 if its floor belongs to this level
        std::vector<char> reached;    // by column: 1 if the body can drive there
        std::vector<int> object_ids;  // by object of `plan`; 0: no-go box or floor edge
        RayCaster plan;
    };

    [[nodiscard]] int levelAt(const Eigen::Vector3d& place) const;
    [[nodiscard]] Eigen::Vector3d placeOver(std::size_t column, double height) const;
    [[nodiscard]] std::vector<double> findHeights(const FreeSpace& free_space,
                                                  const FloorHeights& floors) const;
    [[nodiscard]] std::vector<char> floorOf(double height, const FloorHeights& floors) const;
    [[nodiscard]] Level makeLevel(const Scene& scene, const FloorHeights& floors,
                                  const std::vector<NoGoBox>& no_go, double height) const;
    void reach(Level& level, const RayCaster& rays, const FreeSpace& free_space,
               const std::vector<NoGoBox>& no_go, double camera_radius_m);

    BodyParams body_;
    double radius_m_;  // of the cylinder; 0 without one
    ColumnGrid grid_;
    std::vector<Level> levels_;
    std::vector<std::vector<Eigen::Vector3f>> cells_;
};

}  // namespace dollytrack::planning
