#pragma once

#include "planning/free_space/cell_box.h"
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

/// Writes the level of the octree's leaf around it into every cell: leaves are the largest cubes of
/// equal state.
void markLeaves(const VoxelGrid& grid, std::vector<std::uint8_t>& cells);

/// The same, from cells of other states that were marked before. States should differ near these
/// boxes only; where they do elsewhere it takes longer.
void markLeavesAfter(const std::vector<std::uint8_t>& before, const std::vector<CellBox>& likely,
                     const VoxelGrid& grid, std::vector<std::uint8_t>& cells);

/// The tree with those leaves; free has the lowest occupancy, occupied the highest, unknown has no
/// node.
OctreePtr growOctree(const VoxelGrid& grid, const std::vector<std::uint8_t>& cells);

/// Whether the grid lies within the reach of an octree's 16-bit keys.
bool fitsOctree(const VoxelGrid& grid);

}  // namespace dollytrack::planning
