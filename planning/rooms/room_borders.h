#pragma once

#include "planning/free_space/voxel_grid.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

class FloorHeights;
class FreeSpace;

/// The heights at which the camera fits, by column of the plan.
struct AirColumns {
    std::vector<char> fits;
    std::vector<char> walks;        // it fits near the floor: not over a table or in a window
    std::vector<double> low, high;  // m
};

AirColumns airOver(const VoxelGrid& grid, const std::vector<int>& part_of_column,
                   const FreeSpace& free_space, const FloorHeights& floors);

/// A connected stretch along which two parts of the plan touch and the camera can walk across.
struct Border {
    int a = 0;
    int b = 0;
    std::vector<std::size_t> columns;                   // of part a, next to part b, rising
    Eigen::Vector2d through = Eigen::Vector2d::Zero();  // sum of the steps from a to b
};

std::vector<Border> findBorders(const VoxelGrid& plane, const std::vector<int>& part_of_column,
                                const AirColumns& air);

/// How far apart its ends are, m.
double widthOf(const Border& border, const VoxelGrid& plane);

/// The column of the border that is nearest to its middle.
std::size_t middleOf(const Border& border, const VoxelGrid& plane);

}  // namespace dollytrack::planning
