#include "planning/free_space/enclosure.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/enclosure_rays.h"

#include <array>

namespace dollytrack::planning {
namespace {

// Labels of cells while open cells are assigned to a side; 0 for cells with surface or outside the
// room bounds.
constexpr std::uint8_t kIn = 1;
constexpr std::uint8_t kOut = 2;
constexpr std::uint8_t kOpen = 4;

/// Whether a cell has floor, ceiling and walls nearly all round. Such a cell may be inside although
/// its column belongs to an outside part, for example in a bay window.
bool isSurrounded(std::uint8_t ray_bits) {
    constexpr unsigned kBoth = kFloorBelow | kCeilingAbove;
    return (ray_bits & kEnclosureHitsMask) >= 12 && (ray_bits & kBoth) == kBoth;
}

/// Labels of cells before open cells are assigned.
class Sides {
  public:
    Sides(const EnclosureInput& seen, const FloorPlan& plan, const EnclosureClassifier& classifier)
        : seen_(seen), plan_(plan), classifier_(classifier), columns_(seen.grid.rowOf(0, 1)) {}

    /// Label of a cell without surface within the room bounds.
    [[nodiscard]] std::uint8_t ofAir(std::size_t i, std::size_t column, std::size_t z) const {
        const int part = plan_.part_of_column[column];
        if (part == kNoPart) return kOpen;
        if (classifier_.inside()[part][z] != 0) return kIn;
        return classifier_.isRoofed() && isSurrounded(seen_.ray_bits[i]) ? kOpen : kOut;
    }
    /// Label of any cell.
    [[nodiscard]] std::uint8_t operator()(std::size_t i) const {
        const std::size_t column = i % columns_;
        const std::size_t z = i / columns_;
        const std::size_t width = seen_.grid.count[0];
        const bool in_room =
            seen_.grid.inRoom(static_cast<int>(column % width), static_cast<int>(column / width),
                              static_cast<int>(z));
        return in_room && seen_.surfaces[i] == 0 ? ofAir(i, column, z) : std::uint8_t{0};
    }

  private:
    const EnclosureInput& seen_;
    const FloorPlan& plan_;
    const EnclosureClassifier& classifier_;
    std::size_t columns_;
};

/// Index offsets to a cell's neighbours. The grid has a rim of cells outside the room bounds, which
/// are 0, so all other cells have neighbours.
std::array<std::size_t, 3> stepsIn(const VoxelGrid& grid) {
    return {1, static_cast<std::size_t>(grid.count[0]), grid.rowOf(0, 1)};
}

/// Breadth-first growth of the labels in `front` through open cells. Inside cells come first in the
/// front, and therefore win ties.
void grow(std::vector<std::size_t> front, const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    const std::array<std::size_t, 3> steps = stepsIn(grid);
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

/// Assigns air in wall columns (in doors and windows, above and in cupboards) to the nearest side
/// by paths through open cells. The cut between two sides is in the middle of the opening.
void shareOutWalls(const VoxelGrid& grid, std::vector<std::uint8_t>& cells) {
    const std::array<std::size_t, 3> steps = stepsIn(grid);
    std::vector<std::size_t> front;
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
    grow(std::move(front), grid, cells);
}

/// Repeats the assignment for all open cells connected with one of `among`. Other open regions do
/// not influence them.
void shareOutAgain(const std::vector<std::size_t>& among, const Sides& side, const VoxelGrid& grid,
                   std::vector<std::uint8_t>& inside) {
    const std::array<std::size_t, 3> steps = stepsIn(grid);
    std::vector<std::uint8_t> cells(grid.size(), 0);
    std::vector<std::size_t> open;
    for (const std::size_t seed : among) {
        if (cells[seed] != 0 || side(seed) != kOpen) continue;
        cells[seed] = kOpen;
        open.push_back(seed);
    }
    std::array<std::vector<std::size_t>, 2> beside;  // open cells next to inside air; next to
                                                     // outside air
    for (std::size_t k = 0; k < open.size(); ++k) {
        std::uint8_t around = 0;
        for (const std::size_t step : steps) {
            for (const std::size_t to : {open[k] - step, open[k] + step}) {
                if (cells[to] == kOpen) continue;
                const std::uint8_t what = side(to);
                around |= what;
                if (what != kOpen) continue;
                cells[to] = kOpen;
                open.push_back(to);
            }
        }
        if ((around & kIn) != 0) {
            beside[0].push_back(open[k]);
        } else if ((around & kOut) != 0) {
            beside[1].push_back(open[k]);
        }
    }
    for (const std::size_t i : beside[0]) cells[i] = kIn;
    for (const std::size_t i : beside[1]) cells[i] = kOut;
    std::vector<std::size_t> front = beside[0];
    front.insert(front.end(), beside[1].begin(), beside[1].end());
    grow(std::move(front), grid, cells);
    for (const std::size_t i : open) inside[i] = cells[i] & kIn;
}

}  // namespace

Enclosure::Enclosure(const EnclosureInput& seen, const FloorPlan& plan, EnclosureRule rule)
    : rule_(rule), classifier_(seen, plan, rule) {
    fill(seen, plan);
}

Enclosure::Enclosure(const Enclosure& other, const EnclosureInput& before,
                     const EnclosureInput& now, const FloorPlan& plan,
                     const std::vector<CellBox>& changed)
    : rule_(other.rule_), classifier_(other.classifier_) {
    if (!classifier_.recount(before, now, plan, changed)) {
        classifier_ = EnclosureClassifier(now, plan, rule_);
        fill(now, plan);
        return;
    }
    if (classifier_.inside() != other.classifier_.inside()) {
        fill(now, plan);
        return;
    }
    cells_ = other.cells_;
    const Sides was(before, plan, classifier_);
    const Sides is(now, plan, classifier_);
    std::vector<std::size_t> open;
    for (const CellBox& box : changed) {
        visitRows(box, now.grid, [&](std::size_t begin, std::size_t end, int, int, int) {
            for (std::size_t i = begin; i < end; ++i) {
                if (now.surfaces[i] == before.surfaces[i] &&
                    now.ray_bits[i] == before.ray_bits[i]) {
                    continue;
                }
                const std::uint8_t side = is(i);
                if (side == was(i)) continue;
                cells_[i] = side & kIn;
                open.push_back(i);
                for (const std::size_t step : stepsIn(now.grid)) {
                    open.push_back(i - step);
                    open.push_back(i + step);
                }
            }
        });
    }
    shareOutAgain(open, is, now.grid, cells_);
}

void Enclosure::fill(const EnclosureInput& seen, const FloorPlan& plan) {
    const VoxelGrid& grid = seen.grid;
    const std::size_t columns = grid.rowOf(0, 1);
    cells_.assign(grid.size(), 0);
    const Sides side(seen, plan, classifier_);
    parallelFor(grid.count[2], [&](std::size_t z) {
        seen.visitAir(wholeGrid(grid), static_cast<int>(z),
                      [&](std::size_t i) { cells_[i] = side.ofAir(i, i - z * columns, z); });
    });
    shareOutWalls(grid, cells_);
    for (std::uint8_t& cell : cells_) cell &= kIn;
}

}  // namespace dollytrack::planning
