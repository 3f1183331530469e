#pragma once

#include "planning/free_space/voxel_grid.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace octomap {
class OcTree;
}

namespace dollytrack::planning {

/// Deletes an OctoMap tree where only its name is known.
struct OctreeDeleter {
    void operator()(octomap::OcTree* tree) const;
};
using OctreePtr = std::unique_ptr<octomap::OcTree, OctreeDeleter>;

/// What a cell is, in two bits; the bits above them hold the level of the octree's leaf around it
/// (0: the smallest cell).
constexpr std::uint8_t kUnknownCell = 0;
constexpr std::uint8_t kFreeCell = 1;
constexpr std::uint8_t kOccupiedCell = 2;
constexpr std::uint8_t kCellStateMask = 3;
constexpr int kCellLevelShift = 2;

/// Builds the tree from the states of the grid's cells, with a leaf for each largest cube of equal
/// state; free has the lowest occupancy, occupied the highest, unknown has no node. Writes the
/// leaf's level into every cell.
OctreePtr buildOctree(const VoxelGrid& grid, std::vector<std::uint8_t>& cells);

/// Whether the grid lies within the reach of an octree's 16-bit keys.
bool fitsOctree(const VoxelGrid& grid);

}  // namespace dollytrack::planning
