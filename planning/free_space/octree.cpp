#include "planning/free_space/octree.h"

#include "engine/jobs/parallel.h"

#include <octomap/OcTree.h>

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr int kDepth = 16;           // of an OctoMap tree
constexpr int kKeyOffset = 1 << 15;  // key of the cell that begins at 0
constexpr std::uint8_t kMixed = 3;   // a cube with more than one state
constexpr int kRootLevel = kDepth;   // a cube of level n is 2^n cells wide
using Cube = std::array<int, 3>;     // in cubes of its level, counted from key 0

/// The state of every cube of one level that touches the grid; kMixed where it is not uniform.
struct Level {
    Cube first = {0, 0, 0};
    Cube count = {0, 0, 0};
    std::vector<std::uint8_t> states;

    [[nodiscard]] std::uint8_t at(const Cube& cube) const {
        std::size_t index = 0;
        for (const unsigned k : {2U, 1U, 0U}) {
            const int i = cube[k] - first[k];
            if (i < 0 || i >= count[k]) return kUnknownCell;
            index = index * static_cast<std::size_t>(count[k]) + static_cast<std::size_t>(i);
        }
        return states[index];
    }
};

Level finestLevel(const VoxelGrid& grid, const std::vector<std::uint8_t>& cells) {
    Level level;
    for (unsigned k = 0; k < 3; ++k) level.first[k] = grid.first[k] + kKeyOffset;
    level.count = grid.count;
    level.states = cells;
    return level;
}

Level coarser(const Level& fine) {
    Level level;
    std::size_t size = 1;
    for (unsigned k = 0; k < 3; ++k) {
        level.first[k] = fine.first[k] >> 1;
        level.count[k] = ((fine.first[k] + fine.count[k] - 1) >> 1) - level.first[k] + 1;
        size *= static_cast<std::size_t>(level.count[k]);
    }
    level.states.resize(size);
    const auto [nx, ny, nz] = level.count;
    parallelFor(static_cast<std::size_t>(nz), [&, nx = nx, ny = ny](std::size_t z) {
        std::size_t index = z * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nx);
        for (int y = 0; y < ny; ++y) {
            for (int x = 0; x < nx; ++x, ++index) {
                std::uint8_t state = kMixed;
                for (int child = 0; child < 8; ++child) {
                    const std::uint8_t part =
                        fine.at({2 * (level.first[0] + x) + (child & 1),
                                 2 * (level.first[1] + y) + (child >> 1 & 1),
                                 2 * (level.first[2] + static_cast<int>(z)) + (child >> 2 & 1)});
                    if (child == 0) state = part;
                    if (part != state) state = kMixed;
                }
                level.states[index] = state;
            }
        }
    });
    return level;
}

/// An OctoMap tree that grows from its root: OctoMap's own calls insert cell by cell.
class GrownTree : public octomap::OcTree {
  public:
    using octomap::OcTree::OcTree;

    void grow(const std::vector<Level>& levels) {
        if (levels.back().at({0, 0, 0}) == kUnknownCell) return;
        root = new octomap::OcTreeNode();
        tree_size = 1;
        growNode(root, levels, kRootLevel, {0, 0, 0});
        size_changed = true;
    }

  private:
    void growNode(octomap::OcTreeNode* node, const std::vector<Level>& levels, int at,
                  const Cube& cube) {
        const std::uint8_t state = levels[static_cast<std::size_t>(at)].at(cube);
        if (state != kMixed) {
            node->setLogOdds(state == kFreeCell ? clamping_thres_min : clamping_thres_max);
            return;
        }
        for (unsigned child = 0; child < 8; ++child) {
            const Cube part = {2 * cube[0] + static_cast<int>(child & 1U),
                               2 * cube[1] + static_cast<int>(child >> 1U & 1U),
                               2 * cube[2] + static_cast<int>(child >> 2U & 1U)};
            if (levels[static_cast<std::size_t>(at) - 1].at(part) == kUnknownCell) continue;
            growNode(createNodeChild(node, child), levels, at - 1, part);
        }
        node->updateOccupancyChildren();
    }
};

/// Writes into every cell the level of the largest uniform cube around it.
void writeLevels(const VoxelGrid& grid, const std::vector<Level>& levels,
                 std::vector<std::uint8_t>& cells) {
    parallelFor(static_cast<std::size_t>(grid.count[2]), [&](std::size_t z) {
        for (int y = 0; y < grid.count[1]; ++y) {
            const std::size_t row = grid.rowOf(y, static_cast<int>(z));
            int level = 0;
            for (int x = 0; x < grid.count[0]; ++x) {
                const Cube key = {grid.first[0] + x + kKeyOffset, grid.first[1] + y + kKeyOffset,
                                  grid.first[2] + static_cast<int>(z) + kKeyOffset};
                const auto uniform = [&](int n) {
                    return levels[static_cast<std::size_t>(n)].at(
                               {key[0] >> n, key[1] >> n, key[2] >> n}) != kMixed;
                };
                // The leaf of the cell before goes on until its cube ends.
                if (x == 0 || (key[0] & ((1 << level) - 1)) == 0) {
                    level = 0;
                    while (level < kRootLevel && uniform(level + 1)) ++level;
                }
                std::uint8_t& cell = cells[row + static_cast<std::size_t>(x)];
                cell = static_cast<std::uint8_t>(cell | level << kCellLevelShift);
            }
        }
    });
}

}  // namespace

void OctreeDeleter::operator()(octomap::OcTree* tree) const {
    delete tree;
}

bool fitsOctree(const VoxelGrid& grid) {
    for (unsigned k = 0; k < 3; ++k) {
        if (grid.first[k] < -kKeyOffset || grid.first[k] + grid.count[k] > kKeyOffset) return false;
    }
    return true;
}

OctreePtr buildOctree(const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    std::vector<Level> levels = {finestLevel(grid, cells)};
    while (levels.size() <= kRootLevel) levels.push_back(coarser(levels.back()));
    auto tree = std::make_unique<GrownTree>(grid.resolution_m);
    tree->grow(levels);
    writeLevels(grid, levels, cells);
    return OctreePtr(tree.release());
}

}  // namespace dollytrack::planning
