#include "planning/free_space/octree.h"

#include "engine/jobs/parallel.h"

#include <octomap/OcTree.h>

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr int kDepth = 16;           // of an OctoMap tree
constexpr int kKeyOffset = 1 << 15;  // key of the cell that begins at coordinate 0
constexpr std::uint8_t kMixed = 3;   // a cube with more than one state
constexpr int kRootLevel = kDepth;   // a cube of level n is 2^n cells wide
using Cube = std::array<int, 3>;     // index in cubes of its level, counted from key 0

/// The states of all cubes of one level that touch the grid; kMixed where not uniform.
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

/// The level of single cells, for the cells in a box.
Level finestLevel(const VoxelGrid& grid, const CellBox& box,
                  const std::vector<std::uint8_t>& cells) {
    Level level;
    for (unsigned k = 0; k < 3; ++k) {
        level.first[k] = grid.first[k] + box.begin[k] + kKeyOffset;
        level.count[k] = box.size(k);
    }
    const std::size_t width = box.size(0);
    const std::size_t depth = box.size(1);
    level.states.resize(width * depth * static_cast<std::size_t>(box.size(2)));
    parallelFor(box.size(2), [&](std::size_t z) {
        for (std::size_t y = 0; y < depth; ++y) {
            const std::uint8_t* from =
                cells.data() + grid.indexOf(box.begin[0], box.begin[1] + static_cast<int>(y),
                                            box.begin[2] + static_cast<int>(z));
            std::uint8_t* to = level.states.data() + (z * depth + y) * width;
            for (std::size_t x = 0; x < width; ++x) to[x] = from[x] & kCellStateMask;
        }
    });
    return level;
}

/// The common state, or kMixed.
constexpr std::uint8_t joined(std::uint8_t a, std::uint8_t b) {
    return a == b ? a : kMixed;
}

/// Joins the states of a fine row in pairs, to a coarse row; cells outside are unknown.
void joinPairs(const std::uint8_t* fine, int fine_first, int fine_count, int coarse_first,
               std::vector<std::uint8_t>& coarse) {
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        const int x = 2 * (coarse_first + static_cast<int>(i)) - fine_first;
        const std::uint8_t a = x >= 0 && x < fine_count ? fine[x] : kUnknownCell;
        const std::uint8_t b = x + 1 >= 0 && x + 1 < fine_count ? fine[x + 1] : kUnknownCell;
        coarse[i] = joined(a, b);
    }
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
    const std::size_t width = nx;
    parallelFor(nz, [&, ny = ny](std::size_t z) {
        const std::vector<std::uint8_t> unknown(width, kUnknownCell);
        std::vector<std::uint8_t> pairs(width);
        for (int y = 0; y < ny; ++y) {
            std::uint8_t* row =
                level.states.data() +
                (z * static_cast<std::size_t>(ny) + static_cast<std::size_t>(y)) * width;
            for (int part = 0; part < 4; ++part) {
                const int fine_y = 2 * (level.first[1] + y) + (part & 1) - fine.first[1];
                const int fine_z =
                    2 * (level.first[2] + static_cast<int>(z)) + (part >> 1) - fine.first[2];
                const bool within =
                    fine_y >= 0 && fine_y < fine.count[1] && fine_z >= 0 && fine_z < fine.count[2];
                if (within) {
                    joinPairs(fine.states.data() + (static_cast<std::size_t>(fine_z) *
                                                        static_cast<std::size_t>(fine.count[1]) +
                                                    static_cast<std::size_t>(fine_y)) *
                                                       static_cast<std::size_t>(fine.count[0]),
                              fine.first[0], fine.count[0], level.first[0], pairs);
                }
                const std::vector<std::uint8_t>& from = within ? pairs : unknown;
                for (std::size_t x = 0; x < width; ++x) {
                    row[x] = part == 0 ? from[x] : joined(row[x], from[x]);
                }
            }
        }
    });
    return level;
}

/// The levels from single cells up to `top`.
std::vector<Level> levelsUpTo(int top, const VoxelGrid& grid, const CellBox& box,
                              const std::vector<std::uint8_t>& cells) {
    std::vector<Level> levels = {finestLevel(grid, box, cells)};
    while (levels.size() <= static_cast<std::size_t>(top)) levels.push_back(coarser(levels.back()));
    return levels;
}

/// Writes the leaf levels into the cells of a box, up to the coarsest of the given levels.
void markIn(const CellBox& box, const std::vector<Level>& levels, const VoxelGrid& grid,
            std::vector<std::uint8_t>& cells) {
    const int top = static_cast<int>(levels.size()) - 1;
    parallelFor(box.size(2), [&](std::size_t slice) {
        const int z = box.begin[2] + static_cast<int>(slice);
        for (int y = box.begin[1]; y < box.end[1]; ++y) {
            const std::size_t row = grid.rowOf(y, z);
            for (int x = box.begin[0]; x < box.end[0];) {
                const Cube key = {grid.first[0] + x + kKeyOffset, grid.first[1] + y + kKeyOffset,
                                  grid.first[2] + z + kKeyOffset};
                int level = 0;
                while (level < top &&
                       levels[level + 1].at({key[0] >> (level + 1), key[1] >> (level + 1),
                                             key[2] >> (level + 1)}) != kMixed) {
                    ++level;
                }
                // The leaf extends to the end of its cube.
                const int next = (((key[0] >> level) + 1) << level) - key[0] + x;
                const int end = std::min(next, box.end[0]);
                for (; x < end; ++x) {
                    std::uint8_t& cell = cells[row + static_cast<std::size_t>(x)];
                    cell = static_cast<std::uint8_t>((cell & kCellStateMask) |
                                                     level << kCellLevelShift);
                }
            }
        }
    });
}

/// The cells of all cubes of one level that the box touches, clipped to the grid.
CellBox wholeCubes(const CellBox& box, int level, const VoxelGrid& grid) {
    CellBox cubes;
    for (unsigned k = 0; k < 3; ++k) {
        const int first = grid.first[k] + kKeyOffset;
        const int low = ((first + box.begin[k]) >> level) << level;
        const int high = (((first + box.end[k] - 1) >> level) + 1) << level;
        cubes.begin[k] = std::max(low - first, 0);
        cubes.end[k] = std::min(high - first, grid.count[k]);
    }
    return cubes;
}

/// Whether the box contains a leaf of this level or larger.
bool hasLeaf(int level, const CellBox& box, const VoxelGrid& grid,
             const std::vector<std::uint8_t>& cells) {
    std::uint8_t largest = 0;
    visitRows(box, grid, [&](std::size_t begin, std::size_t end, int, int, int) {
        for (std::size_t i = begin; i < end; ++i) largest = std::max(largest, cells[i]);
    });
    return largest >> kCellLevelShift >= level;
}

/// Updates the leaves that a change in the box can affect. If all cubes of a level around the
/// change are mixed, before and after, then all larger cubes are mixed as well, and no leaf outside
/// them changes.
void markAround(const CellBox& changed, const std::vector<std::uint8_t>& before,
                const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    constexpr int kFirstTry = 2;
    for (int top = kFirstTry;; ++top) {
        const CellBox box = wholeCubes(changed, std::min(top, kRootLevel), grid);
        const std::vector<Level> levels = levelsUpTo(std::min(top, kRootLevel), grid, box, cells);
        const bool done =
            top >= kRootLevel ||
            (std::ranges::all_of(levels.back().states,
                                 [](std::uint8_t state) { return state == kMixed; }) &&
             !hasLeaf(top, box, grid, before));
        if (done) return markIn(box, levels, grid, cells);
    }
}

/// An OctoMap tree built recursively from its root; OctoMap's interface inserts one cell at a time.
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
        const std::uint8_t state = levels[at].at(cube);
        if (state != kMixed) {
            node->setLogOdds(state == kFreeCell ? clamping_thres_min : clamping_thres_max);
            return;
        }
        for (unsigned child = 0; child < 8; ++child) {
            const Cube part = {2 * cube[0] + static_cast<int>(child & 1U),
                               2 * cube[1] + static_cast<int>(child >> 1U & 1U),
                               2 * cube[2] + static_cast<int>(child >> 2U & 1U)};
            if (levels[at - 1].at(part) == kUnknownCell) continue;
            growNode(createNodeChild(node, child), levels, at - 1, part);
        }
        node->updateOccupancyChildren();
    }
};

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

void markLeaves(const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    const CellBox all = wholeGrid(grid);
    markIn(all, levelsUpTo(kRootLevel, grid, all, cells), grid, cells);
}

void markLeavesAfter(const std::vector<std::uint8_t>& before, const std::vector<CellBox>& likely,
                     const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    parallelRanges(cells.size(), 1U << 16U, [&](std::size_t begin, std::size_t end) {
        std::uint8_t* cell = cells.data();
        const std::uint8_t* leaf = before.data();
        constexpr std::uint8_t kLeaf = static_cast<std::uint8_t>(~unsigned{kCellStateMask});
        for (std::size_t i = begin; i < end; ++i) {
            cell[i] = static_cast<std::uint8_t>((cell[i] & kCellStateMask) | (leaf[i] & kLeaf));
        }
    });
    for (const CellBox& changed : changedBoxes(likely, grid, before, cells)) {
        markAround(changed, before, grid, cells);
    }
}

OctreePtr growOctree(const VoxelGrid& grid, const std::vector<std::uint8_t>& cells) {
    auto tree = std::make_unique<GrownTree>(grid.resolution_m);
    tree->grow(levelsUpTo(kRootLevel, grid, wholeGrid(grid), cells));
    return OctreePtr(tree.release());
}

}  // namespace dollytrack::planning
