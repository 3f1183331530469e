#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack {
class RayCaster;
}

namespace dollytrack::planning {

class FreeSpace;

/// Grid of columns of map cells, row by row from the lowest x and y; world frame, m.
struct ColumnGrid {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    double cell_m = 0.1;
    int columns_x = 0;
    int columns_y = 0;

    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(columns_x) * static_cast<std::size_t>(columns_y);
    }
    /// Index of the column at a position; -1 outside the grid.
    [[nodiscard]] int columnOf(const Eigen::Vector3d& place) const;
    [[nodiscard]] Eigen::Vector2d centreOf(std::size_t column) const;
};

/// Height of the floor below a position: the highest roughly horizontal surface of structure (not
/// furniture or rugs) below it, sampled at the centre of each column of map cells. Floors of
/// several storeys, stairs and steps are told apart. In columns without a floor, horizontal
/// surfaces of walls and ceilings count (for a shell modelled as one wall); doors and windows never
/// count. A room gets a level floor where its free space begins, but not below the building, if
/// most of its columns have no such surface (a house whose ground is in another file). In any other
/// column without a surface, the floor's height is that of the room. Immutable.
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

    [[nodiscard]] const ColumnGrid& grid() const { return grid_; }
    /// Floor heights in a column, z in the world, m, ascending.
    [[nodiscard]] const std::vector<float>& at(std::size_t column) const { return floors_[column]; }

  private:
    [[nodiscard]] double roomFloor(const Eigen::Vector3d& place) const;
    [[nodiscard]] std::vector<std::size_t> columnsOver(std::size_t room) const;
    [[nodiscard]] bool hasFloor(const FreeSpace& free_space, std::size_t room) const;
    void addLevelFloor(std::size_t room);

    ColumnGrid grid_;
    std::vector<std::vector<float>> floors_;  // by column, ascending
    struct RoomFloor {
        Eigen::AlignedBox3d box;
        double height = 0.0;
    };
    std::vector<RoomFloor> rooms_;
};

}  // namespace dollytrack::planning
