#include "planning/free_space/enclosure.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/sight.h"
#include "planning/free_space/voxelize.h"

#include <algorithm>
#include <array>

namespace dollytrack::planning {
namespace {

// Share of a part's possible cells that must be certain; more where it has neither floor nor
// ceiling of its own, since a yard between two wings has walls on three sides, too.
constexpr double kCertainShare = 0.25;
constexpr double kCertainShareInOpen = 0.5;
// A part with so much furniture is lived in, walls or not: its things are to be seen.
constexpr double kFurnishedShare = 0.05;
constexpr double kFurnishedArea_m2 = 2.0;
constexpr double kFurnishedHits = 3.0;  // directions with walls, on average, up to a height
// Share of the air at one height of a part that must be possible.
constexpr double kPossibleShare = 0.5;
// When so many of the certain cells have floor and ceiling, the building is roofed: a niche of the
// facade with walls on three sides is then not inside.
constexpr double kRoofedShare = 0.7;
// Heights between two that are inside are, too, when they are at most so many: windows, doors.
constexpr double kOpenHeight_m = 1.6;

enum class Verdict { Outside, Possible, Certain };

Verdict judge(EnclosureRule rule, bool roofed, std::uint8_t sight) {
    const int hits = sight & kSightHitsMask;
    const bool floor = (sight & kFloorBelow) != 0;
    const bool ceiling = (sight & kCeilingAbove) != 0;
    bool certain = false;
    bool possible = false;
    switch (rule) {
        case EnclosureRule::Walls:
            certain = (hits >= 12 && !roofed) || (hits >= 8 && floor && ceiling);
            possible = hits >= 8 && (!roofed || ceiling);
            break;
        case EnclosureRule::FewWalls:
            certain = hits >= 8 || (hits >= 5 && floor);
            possible = hits >= 4 && floor;
            break;
        case EnclosureRule::FloorOnly:
            certain = floor;
            break;
    }
    return certain ? Verdict::Certain : possible ? Verdict::Possible : Verdict::Outside;
}

/// Between floor and ceiling and walls nearly all round: in a bay window, say, whose column of the
/// plan went to the garden.
bool isSurrounded(std::uint8_t sight) {
    constexpr unsigned kBoth = kFloorBelow | kCeilingAbove;
    return (sight & kSightHitsMask) >= 12 && (sight & kBoth) == kBoth;
}

/// Votes of one part at one height.
struct Votes {
    std::int64_t air = 0;
    std::int64_t possible = 0;  // certain ones among them
    std::int64_t certain = 0;
    std::int64_t covered = 0;  // with floor below or ceiling above
    std::int64_t hits = 0;
};

class Election {
  public:
    Election(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces,
             const std::vector<std::uint8_t>& sight, const FloorPlan& plan)
        : grid_(grid), surfaces_(surfaces), sight_(sight), plan_(plan) {}

    /// Calls visit(index, part) for the air of one slice; part may be kNoPart.
    template <class Visit>
    void visitAir(int z, Visit&& visit) const {
        if (z < grid_.room_begin[2] || z >= grid_.room_end[2]) return;
        for (int y = grid_.room_begin[1]; y < grid_.room_end[1]; ++y) {
            const std::size_t row = grid_.rowOf(y, z);
            const std::size_t column = grid_.rowOf(y, 0);
            for (int x = grid_.room_begin[0]; x < grid_.room_end[0]; ++x) {
                const std::size_t i = row + static_cast<std::size_t>(x);
                const int part = plan_.part_of_column[column + static_cast<std::size_t>(x)];
                if (surfaces_[i] == 0) visit(i, part);
            }
        }
    }

    [[nodiscard]] bool isRoofed() const {
        std::vector<std::array<std::int64_t, 2>> slices(static_cast<std::size_t>(grid_.count[2]));
        parallelFor(slices.size(), [&](std::size_t z) {
            visitAir(static_cast<int>(z), [&](std::size_t i, int) {
                if (judge(EnclosureRule::Walls, false, sight_[i]) != Verdict::Certain) return;
                constexpr unsigned kBoth = kFloorBelow | kCeilingAbove;
                ++slices[z][0];
                slices[z][1] += (sight_[i] & kBoth) == kBoth ? 1 : 0;
            });
        });
        std::int64_t certain = 0;
        std::int64_t between = 0;
        for (const auto& slice : slices) {
            certain += slice[0];
            between += slice[1];
        }
        return static_cast<double>(between) >= kRoofedShare * static_cast<double>(certain);
    }

    /// For every part whether it is inside, one entry a height.
    [[nodiscard]] std::vector<std::vector<std::uint8_t>> decide(EnclosureRule rule,
                                                                bool roofed) const {
        const auto heights = static_cast<std::size_t>(grid_.count[2]);
        std::vector<std::vector<Votes>> votes(
            heights, std::vector<Votes>(static_cast<std::size_t>(plan_.parts)));
        parallelFor(heights, [&](std::size_t z) {
            visitAir(static_cast<int>(z), [&](std::size_t i, int part) {
                if (part == kNoPart) return;
                const Verdict verdict = judge(rule, roofed, sight_[i]);
                Votes& count = votes[z][static_cast<std::size_t>(part)];
                ++count.air;
                count.possible += verdict != Verdict::Outside ? 1 : 0;
                count.certain += verdict == Verdict::Certain ? 1 : 0;
                count.covered += (sight_[i] & (kFloorBelow | kCeilingAbove)) != 0 ? 1 : 0;
                count.hits += sight_[i] & kSightHitsMask;
            });
        });
        const std::vector<std::uint8_t> furnished = findFurnished();
        std::vector<std::vector<std::uint8_t>> inside(static_cast<std::size_t>(plan_.parts),
                                                      std::vector<std::uint8_t>(heights, 0));
        for (std::size_t part = 0; part < inside.size(); ++part) {
            Votes sum;
            for (const auto& height : votes) {
                sum.air += height[part].air;
                sum.possible += height[part].possible;
                sum.certain += height[part].certain;
                sum.covered += height[part].covered;
            }
            const double needed = 2 * sum.covered < sum.air ? kCertainShareInOpen : kCertainShare;
            const bool carried = sum.certain > 0 && static_cast<double>(sum.certain) >=
                                                        needed * static_cast<double>(sum.possible);
            for (std::size_t z = 0; z < heights; ++z) {
                const Votes& count = votes[z][part];
                const auto air = static_cast<double>(count.air);
                const bool walled = carried && count.possible > 0 &&
                                    static_cast<double>(count.possible) >= kPossibleShare * air;
                const bool lived_in = furnished[part] != 0 && count.air > 0 &&
                                      static_cast<double>(count.hits) >= kFurnishedHits * air;
                inside[part][z] = walled || lived_in ? 1 : 0;
            }
            closeGaps(inside[part]);
        }
        return inside;
    }

  private:
    /// Parts on whose floor much furniture stands, by columns that hold something of the building
    /// that is no structure.
    [[nodiscard]] std::vector<std::uint8_t> findFurnished() const {
        std::vector<std::uint8_t> thing(plan_.part_of_column.size(), 0);
        parallelFor(static_cast<std::size_t>(grid_.count[1]), [&](std::size_t y) {
            const std::size_t column = grid_.rowOf(static_cast<int>(y), 0);
            for (int z = 0; z < grid_.count[2]; ++z) {
                const std::size_t row = grid_.rowOf(static_cast<int>(y), z);
                for (std::size_t x = 0; x < static_cast<std::size_t>(grid_.count[0]); ++x) {
                    const unsigned kind = surfaces_[row + x] & (kBuilding | kStructure);
                    if (kind == kBuilding) thing[column + x] = 1;
                }
            }
        });
        std::vector<std::array<std::int64_t, 2>> columns(static_cast<std::size_t>(plan_.parts));
        for (std::size_t i = 0; i < thing.size(); ++i) {
            if (plan_.part_of_column[i] == kNoPart) continue;
            auto& count = columns[static_cast<std::size_t>(plan_.part_of_column[i])];
            ++count[0];
            count[1] += thing[i];
        }
        std::vector<std::uint8_t> furnished(columns.size(), 0);
        const double cell_area = grid_.resolution_m * grid_.resolution_m;
        for (std::size_t part = 0; part < columns.size(); ++part) {
            const auto things = static_cast<double>(columns[part][1]);
            furnished[part] = things >= kFurnishedShare * static_cast<double>(columns[part][0]) &&
                              things * cell_area >= kFurnishedArea_m2;
        }
        return furnished;
    }

    void closeGaps(std::vector<std::uint8_t>& inside) const {
        const auto most = static_cast<std::size_t>(kOpenHeight_m / grid_.resolution_m);
        std::size_t last = inside.size();  // the last height inside so far; none yet
        for (std::size_t z = 0; z < inside.size(); ++z) {
            if (inside[z] == 0) continue;
            if (last < z && z - last <= most + 1) {
                std::fill(inside.begin() + static_cast<std::ptrdiff_t>(last),
                          inside.begin() + static_cast<std::ptrdiff_t>(z), std::uint8_t{1});
            }
            last = z;
        }
    }

    const VoxelGrid& grid_;
    const std::vector<std::uint8_t>& surfaces_;
    const std::vector<std::uint8_t>& sight_;
    const FloorPlan& plan_;
};

// What a cell is while the walls' air is shared out.
constexpr std::uint8_t kIn = 1;
constexpr std::uint8_t kOut = 2;
constexpr std::uint8_t kOpen = 4;

/// Air in the columns of walls (in doors and windows, over and in cupboards) belongs to the side
/// whose air reaches it first; between two sides the cut is in the middle of the opening.
void shareOutWalls(const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    // Cells outside the room's bounds are 0, and the grid has a rim of them, so neighbours exist.
    const std::array<std::size_t, 3> steps = {1, static_cast<std::size_t>(grid.count[0]),
                                              grid.rowOf(0, 1)};
    std::vector<std::size_t> front;
    // The inside comes first in every wave, so it wins ties.
    for (const std::uint8_t side : {kIn, kOut}) {
        for (std::size_t i = steps[2]; i + steps[2] < cells.size(); ++i) {
            if (cells[i] != side) continue;
            for (const std::size_t step : steps) {
                if (cells[i - step] != kOpen && cells[i + step] != kOpen) continue;
                front.push_back(i);
                break;
            }
        }
    }
    std::vector<std::size_t> next;
    while (!front.empty()) {
        next.clear();
        for (const std::size_t from : front) {
            for (const std::size_t step : steps) {
                for (const std::size_t to : {from - step, from + step}) {
                    if (cells[to] != kOpen) continue;
                    cells[to] = cells[from];
                    next.push_back(to);
                }
            }
        }
        front.swap(next);
    }
}

}  // namespace

std::vector<std::uint8_t> findInside(const VoxelGrid& grid,
                                     const std::vector<std::uint8_t>& surfaces,
                                     const std::vector<std::uint8_t>& sight, const FloorPlan& plan,
                                     EnclosureRule rule) {
    const Election election(grid, surfaces, sight, plan);
    const bool roofed = election.isRoofed();
    const auto inside = election.decide(rule, roofed);
    std::vector<std::uint8_t> cells(grid.size(), 0);
    parallelFor(static_cast<std::size_t>(grid.count[2]), [&](std::size_t z) {
        election.visitAir(static_cast<int>(z), [&](std::size_t i, int part) {
            const bool in = part != kNoPart && inside[static_cast<std::size_t>(part)][z] != 0;
            const bool bay = roofed && isSurrounded(sight[i]);
            cells[i] = in ? kIn : part == kNoPart || bay ? kOpen : kOut;
        });
    });
    shareOutWalls(grid, cells);
    for (std::uint8_t& cell : cells) cell &= kIn;
    return cells;
}

}  // namespace dollytrack::planning
