#include "planning/free_space/enclosure_classifier.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/enclosure_rays.h"
#include "planning/free_space/voxelize.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

// Share of a part's possible cells that must be certain. It is higher for parts mostly without
// floor and ceiling, since a yard between two wings also has walls on three sides.
constexpr double kCertainShare = 0.25;
constexpr double kCertainShareInOpen = 0.5;
// A part with this much furniture is inside even with few walls, because its objects shall be seen.
constexpr double kFurnishedShare = 0.05;
constexpr double kFurnishedArea_m2 = 2.0;
constexpr double kFurnishedHits = 3.0;  // mean number of directions with walls required at a height
// Share of a part's air cells at one height that must be possible.
constexpr double kPossibleShare = 0.5;
// Share of the certain cells with floor and ceiling from which a building counts as roofed.
constexpr double kRoofedShare = 0.7;
// Heights between two inside heights become inside if the gap is at most this: windows, doors.
constexpr double kOpenHeight_m = 1.6;

constexpr unsigned kFloorAndCeiling = kFloorBelow | kCeilingAbove;

enum class CellEnclosure { Outside, Possible, Certain };

CellEnclosure classify(EnclosureRule rule, bool roofed, std::uint8_t ray_bits) {
    const int hits = ray_bits & kEnclosureHitsMask;
    const bool floor = (ray_bits & kFloorBelow) != 0;
    const bool ceiling = (ray_bits & kCeilingAbove) != 0;
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
    return certain    ? CellEnclosure::Certain
           : possible ? CellEnclosure::Possible
                      : CellEnclosure::Outside;
}

void closeGaps(std::vector<std::uint8_t>& inside, std::size_t most) {
    std::size_t last = inside.size();  // last inside height so far; inside.size(): none yet
    for (std::size_t z = 0; z < inside.size(); ++z) {
        if (inside[z] == 0) continue;
        if (last < z && z - last <= most + 1) {
            std::fill(inside.begin() + static_cast<std::ptrdiff_t>(last),
                      inside.begin() + static_cast<std::ptrdiff_t>(z), std::uint8_t{1});
        }
        last = z;
    }
}

}  // namespace

EnclosureClassifier::EnclosureClassifier(const EnclosureInput& seen, const FloorPlan& plan,
                                         EnclosureRule rule)
    : rule_(rule),
      roof_(static_cast<std::size_t>(seen.grid.count[2])),
      counts_(roof_.size(), std::vector<EnclosureCounts>(static_cast<std::size_t>(plan.parts))),
      furniture_(plan.part_of_column.size(), 0) {
    const CellBox everywhere = wholeGrid(seen.grid);
    countRoof(seen, everywhere, 1);
    roofed_ = hasRoof();
    countCells(seen, plan, everywhere, 1);
    findFurnitureColumns(seen, everywhere);
    decide(seen.grid, plan);
}

bool EnclosureClassifier::recount(const EnclosureInput& before, const EnclosureInput& now,
                                  const FloorPlan& plan, const std::vector<CellBox>& boxes) {
    for (const CellBox& box : boxes) {
        countRoof(before, box, -1);
        countRoof(now, box, 1);
    }
    if (hasRoof() != roofed_) return false;
    for (const CellBox& box : boxes) {
        countCells(before, plan, box, -1);
        countCells(now, plan, box, 1);
        findFurnitureColumns(now, box);
    }
    decide(now.grid, plan);
    return true;
}

void EnclosureClassifier::countRoof(const EnclosureInput& seen, const CellBox& box, int sign) {
    parallelFor(box.size(2), [&](std::size_t slice) {
        const int z = box.begin[2] + static_cast<int>(slice);
        auto& count = roof_[z];
        seen.visitAir(box, z, [&](std::size_t i) {
            if (classify(EnclosureRule::Walls, false, seen.ray_bits[i]) != CellEnclosure::Certain)
                return;
            count[0] += sign;
            if ((seen.ray_bits[i] & kFloorAndCeiling) == kFloorAndCeiling) count[1] += sign;
        });
    });
}

bool EnclosureClassifier::hasRoof() const {
    std::int64_t certain = 0;
    std::int64_t between = 0;
    for (const auto& slice : roof_) {
        certain += slice[0];
        between += slice[1];
    }
    return static_cast<double>(between) >= kRoofedShare * static_cast<double>(certain);
}

void EnclosureClassifier::countCells(const EnclosureInput& seen, const FloorPlan& plan,
                                     const CellBox& box, int sign) {
    const std::size_t columns = seen.grid.rowOf(0, 1);
    parallelFor(box.size(2), [&](std::size_t slice) {
        const int z = box.begin[2] + static_cast<int>(slice);
        std::vector<EnclosureCounts>& counts = counts_[z];
        const std::size_t first = static_cast<std::size_t>(z) * columns;
        seen.visitAir(box, z, [&](std::size_t i) {
            const int part = plan.part_of_column[i - first];
            if (part == kNoPart) return;
            const CellEnclosure enclosure = classify(rule_, roofed_, seen.ray_bits[i]);
            EnclosureCounts& count = counts[part];
            count.air += sign;
            count.possible += enclosure != CellEnclosure::Outside ? sign : 0;
            count.certain += enclosure == CellEnclosure::Certain ? sign : 0;
            count.covered += (seen.ray_bits[i] & kFloorAndCeiling) != 0 ? sign : 0;
            count.hits += sign * (seen.ray_bits[i] & kEnclosureHitsMask);
        });
    });
}

/// Marks the columns that hold surfaces of the building that are not structure.
void EnclosureClassifier::findFurnitureColumns(const EnclosureInput& seen, const CellBox& box) {
    const VoxelGrid& grid = seen.grid;
    parallelFor(box.size(1), [&](std::size_t row_in_box) {
        const int y = box.begin[1] + static_cast<int>(row_in_box);
        std::uint8_t* furniture = furniture_.data() + grid.rowOf(y, 0);
        std::fill(furniture + box.begin[0], furniture + box.end[0], std::uint8_t{0});
        for (int z = 0; z < grid.count[2]; ++z) {
            const std::uint8_t* row = seen.surfaces.data() + grid.rowOf(y, z);
            for (int x = box.begin[0]; x < box.end[0]; ++x) {
                const unsigned kind = row[x] & (kBuilding | kStructure);
                if (kind == kBuilding) furniture[x] = 1;
            }
        }
    });
}

/// By part: 1 if enough of its floor area holds furniture.
std::vector<std::uint8_t> EnclosureClassifier::findFurnished(const VoxelGrid& grid,
                                                             const FloorPlan& plan) const {
    std::vector<std::array<std::int64_t, 2>> columns(plan.parts);
    for (std::size_t i = 0; i < furniture_.size(); ++i) {
        if (plan.part_of_column[i] == kNoPart) continue;
        auto& count = columns[plan.part_of_column[i]];
        ++count[0];
        count[1] += furniture_[i];
    }
    std::vector<std::uint8_t> furnished(columns.size(), 0);
    const double cell_area = grid.resolution_m * grid.resolution_m;
    for (std::size_t part = 0; part < columns.size(); ++part) {
        const auto furniture_columns = static_cast<double>(columns[part][1]);
        furnished[part] =
            furniture_columns >= kFurnishedShare * static_cast<double>(columns[part][0]) &&
            furniture_columns * cell_area >= kFurnishedArea_m2;
    }
    return furnished;
}

void EnclosureClassifier::decide(const VoxelGrid& grid, const FloorPlan& plan) {
    const std::vector<std::uint8_t> furnished = findFurnished(grid, plan);
    const std::size_t heights = counts_.size();
    inside_.assign(plan.parts, std::vector<std::uint8_t>(heights, 0));
    for (std::size_t part = 0; part < inside_.size(); ++part) {
        EnclosureCounts sum;
        for (const auto& height : counts_) {
            sum.air += height[part].air;
            sum.possible += height[part].possible;
            sum.certain += height[part].certain;
            sum.covered += height[part].covered;
        }
        const double needed = 2 * sum.covered < sum.air ? kCertainShareInOpen : kCertainShare;
        const bool carried = sum.certain > 0 && static_cast<double>(sum.certain) >=
                                                    needed * static_cast<double>(sum.possible);
        for (std::size_t z = 0; z < heights; ++z) {
            const EnclosureCounts& count = counts_[z][part];
            const auto air = static_cast<double>(count.air);
            const bool walled = carried && count.possible > 0 &&
                                static_cast<double>(count.possible) >= kPossibleShare * air;
            const bool lived_in = furnished[part] != 0 && count.air > 0 &&
                                  static_cast<double>(count.hits) >= kFurnishedHits * air;
            inside_[part][z] = walled || lived_in ? 1 : 0;
        }
        closeGaps(inside_[part], static_cast<std::size_t>(kOpenHeight_m / grid.resolution_m));
    }
}

}  // namespace dollytrack::planning
