#include "planning/free_space/enclosure.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/components.h"
#include "planning/free_space/distance_field.h"
#include "planning/free_space/voxelize.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::planning {
namespace {

// Working bits of a cell.
constexpr std::uint8_t kFloorBelow = 1;
constexpr std::uint8_t kCeilingAbove = 2;
constexpr std::uint8_t kWeak = 4;     // may be inside
constexpr std::uint8_t kCertain = 8;  // is inside by itself
constexpr std::uint8_t kWide = 16;    // weak or certain, and away from all surfaces
constexpr std::uint8_t kInside = 32;
constexpr std::uint8_t kVotedOut = 64;

// Space is cut where it is narrower than twice this: doors and windows are, missing walls are not.
constexpr double kWideGap_m = 0.9;
// Share of certain cells that carries the weak ones around them.
constexpr double kCarryingShare = 0.25;

struct Step {
    int x = 0;
    int y = 0;
};
constexpr std::array<Step, 16> kAzimuths = {{{1, 0},
                                             {2, 1},
                                             {1, 1},
                                             {1, 2},
                                             {0, 1},
                                             {-1, 2},
                                             {-1, 1},
                                             {-2, 1},
                                             {-1, 0},
                                             {-2, -1},
                                             {-1, -1},
                                             {-1, -2},
                                             {0, -1},
                                             {1, -2},
                                             {1, -1},
                                             {2, -1}}};

/// One horizontal slice with a border of empty cells, so that steps need no limits.
class Slice {
  public:
    Slice(int nx, int ny) : nx_(nx), ny_(ny), stride_(static_cast<std::size_t>(nx) + 2 * kBorder) {
        const std::size_t size = stride_ * (static_cast<std::size_t>(ny) + 2 * kBorder);
        wall_.assign(size, 0);
        hit_.assign(size, 0);
        hits_.assign(size, 0);
    }

    [[nodiscard]] std::size_t rowOf(int y) const {
        return (static_cast<std::size_t>(y) + kBorder) * stride_ + kBorder;
    }
    std::uint8_t* walls(int y) { return wall_.data() + rowOf(y); }
    [[nodiscard]] const std::uint8_t* hits(int y) const { return hits_.data() + rowOf(y); }

    /// Counts for every cell the directions in which it meets a wall.
    void countHits() {
        std::ranges::fill(hits_, std::uint8_t{0});
        for (const Step& step : kAzimuths) sweep(step);
    }

  private:
    static constexpr std::size_t kBorder = 2;

    // A cell meets a wall in one direction when the cells up to the next step are one, or when
    // the cell at the next step meets one.
    void sweep(const Step& step) {
        std::ranges::fill(hit_, std::uint8_t{0});
        const auto stride = static_cast<std::ptrdiff_t>(stride_);
        const std::ptrdiff_t next = step.y * stride + step.x;
        // The two cells that a knight's move passes between; other moves pass none.
        std::ptrdiff_t near_side = next;
        std::ptrdiff_t far_side = next;
        if (std::abs(step.x) == 2) {
            near_side = step.x / 2;
            far_side = near_side + step.y * stride;
        } else if (std::abs(step.y) == 2) {
            near_side = step.y / 2 * stride;
            far_side = near_side + step.x;
        }
        for (int i = 0; i < ny_; ++i) {
            const std::size_t row = rowOf(step.y > 0 ? ny_ - 1 - i : i);
            const std::uint8_t* wall = wall_.data() + row;
            std::uint8_t* hit = hit_.data() + row;
            std::uint8_t* hits = hits_.data() + row;
            if (step.y == 0) {
                for (int k = 0; k < nx_; ++k) {
                    const std::ptrdiff_t x = step.x > 0 ? nx_ - 1 - k : k;
                    hit[x] = wall[x + next] | hit[x + next];
                    hits[x] = static_cast<std::uint8_t>(hits[x] + hit[x]);
                }
            } else {
                // The row before is finished, so all cells of this one are independent.
                const std::uint8_t* before = hit + next;
                const std::uint8_t* a = wall + near_side;
                const std::uint8_t* b = wall + far_side;
                const std::uint8_t* c = wall + next;
                for (std::ptrdiff_t x = 0; x < nx_; ++x) {
                    hit[x] = static_cast<std::uint8_t>(a[x] | b[x] | c[x] | before[x]);
                    hits[x] = static_cast<std::uint8_t>(hits[x] + hit[x]);
                }
            }
        }
    }

    int nx_;
    int ny_;
    std::size_t stride_;
    std::vector<std::uint8_t> wall_;
    std::vector<std::uint8_t> hit_;
    std::vector<std::uint8_t> hits_;
};

/// What is below and above: one pass down and one up through the columns over each row of cells.
void lookUpAndDown(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces,
                   std::vector<std::uint8_t>& cells) {
    const auto [nx, ny, nz] = grid.count;
    parallelFor(static_cast<std::size_t>(ny), [&, nx = nx, nz = nz](std::size_t y) {
        std::vector<std::uint8_t> seen(static_cast<std::size_t>(nx));
        const auto pass = [&](int z, std::uint8_t bit) {
            const std::size_t row = grid.rowOf(static_cast<int>(y), z);
            for (std::size_t x = 0; x < seen.size(); ++x) {
                cells[row + x] = static_cast<std::uint8_t>(cells[row + x] | (seen[x] * bit));
                seen[x] |= static_cast<std::uint8_t>((surfaces[row + x] & kBuilding) / kBuilding);
            }
        };
        for (int z = 0; z < nz; ++z) pass(z, kFloorBelow);
        std::ranges::fill(seen, std::uint8_t{0});
        for (int z = nz - 1; z >= 0; --z) pass(z, kCeilingAbove);
    });
}

/// kWeak and kCertain by the rule, for a cell with hits in so many of the 16 directions.
std::uint8_t judge(EnclosureRule rule, int hits, bool floor, bool ceiling) {
    bool certain = false;
    bool weak = false;
    switch (rule) {
        case EnclosureRule::Walls:
            certain = hits >= 12 || (hits >= 8 && floor && ceiling);
            weak = hits >= 8;
            break;
        case EnclosureRule::FewWalls:
            certain = hits >= 8 || (hits >= 5 && floor);
            weak = hits >= 4 && floor;
            break;
        case EnclosureRule::FloorOnly:
            certain = floor;
            break;
    }
    return certain ? kWeak | kCertain : weak ? kWeak : 0;
}

void judgeSlices(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces,
                 const std::vector<std::uint16_t>& squared_gaps, EnclosureRule rule,
                 std::vector<std::uint8_t>& cells, const JobContext& job) {
    const double wide_cells = kWideGap_m / grid.resolution_m;
    const auto wide = static_cast<std::uint16_t>(
        std::min<double>(std::ceil(wide_cells * wide_cells), kMaxSquaredGap));
    parallelRanges(
        static_cast<std::size_t>(grid.count[2]), 1, [&](std::size_t begin, std::size_t end) {
            Slice slice(grid.count[0], grid.count[1]);
            for (std::size_t at = begin; at < end; ++at) {
                const int z = static_cast<int>(at);
                if (job.cancelled()) return;
                for (int y = 0; y < grid.count[1]; ++y) {
                    const std::size_t row = grid.rowOf(y, z);
                    std::uint8_t* walls = slice.walls(y);
                    for (int x = 0; x < grid.count[0]; ++x) {
                        walls[x] = static_cast<std::uint8_t>(
                            (surfaces[row + static_cast<std::size_t>(x)] & kBuilding) / kBuilding);
                    }
                }
                slice.countHits();
                for (int y = 0; y < grid.count[1]; ++y) {
                    const std::size_t row = grid.rowOf(y, z);
                    const std::uint8_t* hits = slice.hits(y);
                    for (int x = 0; x < grid.count[0]; ++x) {
                        const std::size_t i = row + static_cast<std::size_t>(x);
                        const std::uint8_t sight = cells[i];
                        cells[i] = 0;
                        if (surfaces[i] != 0 || !grid.inRoom(x, y, z)) continue;
                        cells[i] = judge(rule, hits[x], (sight & kFloorBelow) != 0,
                                         (sight & kCeilingAbove) != 0);
                        if (cells[i] != 0 && squared_gaps[i] >= wide) cells[i] |= kWide;
                    }
                }
            }
        });
}

/// Lets each wide space decide for its weak cells.
void vote(const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    const CellComponents spaces = findComponents(grid, cells, kWide);
    std::vector<std::int64_t> certain(spaces.cells.size(), 0);
    for (const CellRun& run : spaces.runs) {
        const std::size_t row = grid.rowOf(run.y, run.z);
        for (int x = run.x_begin; x < run.x_end; ++x) {
            certain[static_cast<std::size_t>(run.component)] +=
                (cells[row + static_cast<std::size_t>(x)] & kCertain) / kCertain;
        }
    }
    for (const CellRun& run : spaces.runs) {
        const auto component = static_cast<std::size_t>(run.component);
        const bool in = static_cast<double>(certain[component]) >=
                        kCarryingShare * static_cast<double>(spaces.cells[component]);
        const std::size_t row = grid.rowOf(run.y, run.z);
        for (int x = run.x_begin; x < run.x_end; ++x) {
            cells[row + static_cast<std::size_t>(x)] |= in ? kInside : kVotedOut;
        }
    }
}

/// Narrow places: certain ones are inside; weak ones belong to the wide place outside near them,
/// else to the place inside near them.
void spread(const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    constexpr std::uint8_t kDecided = kInside | kVotedOut;
    for (std::uint8_t& cell : cells) {
        if ((cell & (kCertain | kDecided)) == kCertain) cell |= kInside;
    }
    const std::size_t slice = grid.rowOf(0, 1);
    const auto row = static_cast<std::size_t>(grid.count[0]);
    const std::array<std::size_t, 3> steps = {1, row, slice};
    // Cells with kWeak are never in the grid's rim, so neighbours exist.
    const auto isOpen = [&](std::size_t i) { return (cells[i] & (kWeak | kDecided)) == kWeak; };
    const auto frontOf = [&](std::uint8_t side) {
        std::vector<std::size_t> front;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if ((cells[i] & side) == 0) continue;
            for (const std::size_t step : steps) {
                if (!isOpen(i - step) && !isOpen(i + step)) continue;
                front.push_back(i);
                break;
            }
        }
        return front;
    };
    std::vector<std::size_t> next;
    const auto advance = [&](std::vector<std::size_t>& front) {
        next.clear();
        for (const std::size_t i : front) {
            const std::uint8_t side = cells[i] & kDecided;
            for (const std::size_t step : steps) {
                for (const std::size_t at : {i - step, i + step}) {
                    if (!isOpen(at)) continue;
                    cells[at] |= side;
                    next.push_back(at);
                }
            }
        }
        front.swap(next);
    };
    // The outside goes first, and far enough to reach the corner of two walls and the ground:
    // near a window there the weak cells are its own, while rooms seldom have weak cells away from
    // their windows.
    const double cells_wide = kWideGap_m / grid.resolution_m;
    std::vector<std::size_t> front = frontOf(kVotedOut);
    for (int wave = 0; wave < std::ceil(1.75 * cells_wide); ++wave) advance(front);
    front = frontOf(kInside);
    for (int wave = 0; wave < std::ceil(cells_wide) + 3; ++wave) advance(front);
}

}  // namespace

std::vector<std::uint8_t> findInside(const VoxelGrid& grid,
                                     const std::vector<std::uint8_t>& surfaces,
                                     const std::vector<std::uint16_t>& squared_gaps,
                                     EnclosureRule rule, const JobContext& job) {
    std::vector<std::uint8_t> cells(grid.size(), 0);
    lookUpAndDown(grid, surfaces, cells);
    judgeSlices(grid, surfaces, squared_gaps, rule, cells, job);
    if (job.cancelled()) return cells;
    vote(grid, cells);
    spread(grid, cells);
    parallelRanges(cells.size(), 1U << 16U, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) cells[i] = (cells[i] & kInside) != 0 ? 1 : 0;
    });
    return cells;
}

}  // namespace dollytrack::planning
