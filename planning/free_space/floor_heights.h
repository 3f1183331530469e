#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

class FreeSpace;

/// Height of the floor below a position: the highest roughly horizontal surface of structure (not
/// furniture or rugs) below it, sampled at the centre of each column of map cells. Floors of
/// several storeys, stairs and steps are told apart. In columns without a floor, horizontal
/// surfaces of walls and ceilings count (for a shell modelled as one wall); doors and windows never
/// count. Where there is no surface, the result is the height at which the room's free space
/// begins. Immutable.
class FloorHeights {
  public:
    FloorHeights(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                 double camera_radius_m);

    struct Span {
        double lowest = 0.0;
        double highest = 0.0;
    };
    /// Lowest and highest floor below the positions of the box, z in the world, m.
    [[nodiscard]] Span below(const Eigen::AlignedBox3d& places) const;

    [[nodiscard]] double below(const Eigen::Vector3d& place) const {
        return below(Eigen::AlignedBox3d(place)).highest;
    }

    // The grid of columns, row by row from the lowest x and y.
    [[nodiscard]] const Eigen::Vector2d& origin() const { return origin_; }
    [[nodiscard]] double cellSize() const { return cell_m_; }
    [[nodiscard]] int columnsX() const { return columns_x_; }
    [[nodiscard]] int columnsY() const { return columns_y_; }
    [[nodiscard]] std::size_t columnCount() const { return floors_.size(); }
    /// Floor heights in a column, z in the world, m, ascending.
    [[nodiscard]] const std::vector<float>& at(std::size_t column) const { return floors_[column]; }
    /// Whether any column has a floor.
    [[nodiscard]] bool hasAny() const;
    /// Height at which the free space of a room begins, z in the world, m.
    [[nodiscard]] double roomFloor(std::size_t room) const { return rooms_[room].height; }

  private:
    [[nodiscard]] double roomFloor(const Eigen::Vector3d& place) const;

    Eigen::Vector2d origin_;
    double cell_m_;
    int columns_x_ = 0;
    int columns_y_ = 0;
    std::vector<std::vector<float>> floors_;  // by column, ascending
    struct RoomFloor {
        Eigen::AlignedBox3d box;
        double height = 0.0;
    };
    std::vector<RoomFloor> rooms_;
};

}  // namespace dollytrack::planning
