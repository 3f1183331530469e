#pragma once

#include "planning/free_space/voxel_grid.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

class FloorHeights;
class FreeSpace;

/// By column of the plan: the heights at which the camera fits.
struct FreeColumns {
    std::vector<char> fits;
    std::vector<char> walks;        // 1 if it fits near the floor, not only above a table or in a
                                    // window
    std::vector<double> low, high;  // z of the lowest and highest cell, m
};

FreeColumns freeColumnsOver(const VoxelGrid& grid, const std::vector<int>& part_of_column,
                            const FreeSpace& free_space, const FloorHeights& floors);

/// A connected part of the border between two parts of the plan that the camera can move across.
struct RoomBorder {
    int a = 0;
    int b = 0;
    std::vector<std::size_t> columns;                   // of part a, next to part b, ascending
    Eigen::Vector2d through = Eigen::Vector2d::Zero();  // sum of the steps from a to b, not
                                                        // normalised
};

std::vector<RoomBorder> findBorders(const VoxelGrid& plane, const std::vector<int>& part_of_column,
                                    const FreeColumns& free_columns);

/// Distance between its farthest columns, m, including one column's width.
double widthOf(const RoomBorder& border, const VoxelGrid& plane);

/// The column of the border nearest to its centroid.
std::size_t middleOf(const RoomBorder& border, const VoxelGrid& plane);

}  // namespace dollytrack::planning
