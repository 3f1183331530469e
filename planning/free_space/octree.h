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

/// Deletes an OctoMap tree where its type is incomplete.
struct OctreeDeleter {
    void operator()(octomap::OcTree* tree) const;
};
using OctreePtr = std::unique_ptr<octomap::OcTree, OctreeDeleter>;

/// State of a cell, in the low two bits. The bits above them hold the level of the octree leaf that
/// contains the cell (0: the smallest cell).
constexpr std::uint8_t kUnknownCell = 0;
constexpr std::uint8_t kFreeCell = 1;
constexpr std::uint8_t kOccupiedCell = 2;
constexpr std::uint8_t kCellStateMask = 3;
constexpr int kCellLevelShift = 2;

/// Writes into every cell the level of the octree leaf that contains it. Leaves are the largest
/// octree cubes of uniform state.
void markLeaves(const VoxelGrid& grid, std::vector<std::uint8_t>& cells);

/// Incremental markLeaves(): `before` are cells with marked leaves, whose states should differ from
/// `cells` only near the boxes `likely`. Other differences are found as well, but take longer.
void markLeavesAfter(const std::vector<std::uint8_t>& before, const std::vector<CellBox>& likely,
                     const VoxelGrid& grid, std::vector<std::uint8_t>& cells);

/// Builds an OctoMap tree with these leaves. Free leaves have the lowest occupancy, occupied leaves
/// the highest; unknown space has no node.
OctreePtr growOctree(const VoxelGrid& grid, const std::vector<std::uint8_t>& cells);

/// Whether the grid lies in the range of an octree's 16-bit keys.
bool fitsOctree(const VoxelGrid& grid);

}  // namespace dollytrack::planning
