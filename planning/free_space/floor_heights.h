#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

class FreeSpace;

/// How high the floor is below a place: the highest level surface of a floor or other structure
/// (not of furniture or rugs) under it, found at the middle of each column of the map's cells. So
/// storeys joined by stairs, and rooms a step higher than others, have floors of their own. In
/// columns without a floor's surface, walls' level ones count (a shell that is all one wall); doors
/// and window sills never. Where there is nothing it is the height at which the room's free space
/// begins. Const.
class FloorHeights {
  public:
    FloorHeights(const Scene& scene, const RayCaster& rays, const FreeSpace& free_space,
                 double camera_radius_m);

    struct Span {
        double lowest = 0.0;
        double highest = 0.0;
    };
    /// The heights of the floors that places in the box have below them, m in the world.
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
    /// Heights of the floors in a column, rising.
    [[nodiscard]] const std::vector<float>& at(std::size_t column) const { return floors_[column]; }
    /// Whether any column has a floor.
    [[nodiscard]] bool hasAny() const;
    /// Where the free space of a room begins, by component.
    [[nodiscard]] double roomFloor(std::size_t room) const { return rooms_[room].height; }

  private:
    [[nodiscard]] double roomFloor(const Eigen::Vector3d& place) const;

    Eigen::Vector2d origin_;
    double cell_m_;
    int columns_x_ = 0;
    int columns_y_ = 0;
    std::vector<std::vector<float>> floors_;  // of each column, rising
    struct RoomFloor {
        Eigen::AlignedBox3d box;
        double height = 0.0;
    };
    std::vector<RoomFloor> rooms_;
};

}  // namespace dollytrack::planning
