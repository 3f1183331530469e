#include "planning/free_space/floor_plan.h"

#include "engine/jobs/parallel.h"
#include "planning/free_space/column_flood.h"
#include "planning/free_space/components.h"
#include "planning/free_space/distance_field.h"
#include "planning/free_space/voxelize.h"

#include <array>
#include <cmath>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kStructureHeight_m = 0.6;
constexpr double kAnyHeight_m = 1.5;
// Distances from walls at which parts are seeded, in turn: rooms, narrow rooms, corridors. The
// first is more than half the width of a door or an unglazed window.
constexpr std::array kPartGaps_m = {0.9, 0.55, 0.3};

std::vector<std::uint8_t> findWalls(const VoxelGrid& grid,
                                    const std::vector<std::uint8_t>& surfaces) {
    const auto [nx, ny, nz] = grid.count;
    std::vector<std::uint8_t> walls(grid.rowOf(0, 1), 0);
    const int structure = static_cast<int>(std::ceil(kStructureHeight_m / grid.resolution_m));
    const int any = static_cast<int>(std::ceil(kAnyHeight_m / grid.resolution_m));
    parallelFor(ny, [&, nx = nx, nz = nz](std::size_t y) {
        std::vector<std::array<int, 2>> heights(nx);
        for (int z = 0; z < nz; ++z) {
            const std::uint8_t* row = surfaces.data() + grid.rowOf(static_cast<int>(y), z);
            for (std::size_t x = 0; x < heights.size(); ++x) {
                constexpr unsigned kUpright = kBuilding | kSteep;
                heights[x][0] += (row[x] & kUpright) == kUpright ? 1 : 0;
                heights[x][1] += (row[x] & (kUpright | kStructure)) == (kUpright | kStructure);
            }
        }
        std::uint8_t* row = walls.data() + grid.rowOf(static_cast<int>(y), 0);
        for (std::size_t x = 0; x < heights.size(); ++x) {
            row[x] = heights[x][0] >= any || heights[x][1] >= structure ? 1 : 0;
        }
    });
    return walls;
}

/// Grows the parts of a plan over a one-layer grid of columns.
class PartGrower {
  public:
    PartGrower(const VoxelGrid& plane, const std::vector<std::uint8_t>& walls, FloorPlan& plan)
        : plane_(plane), walls_(walls), plan_(plan), gaps_(squaredGaps(plane, walls, {})) {
        plan_.part_of_column.assign(plane.size(), kNoPart);
    }

    /// Seeds a new part in every region this far from walls without a part, and grows all new parts
    /// towards the walls only, so that growth ends in the middle of a door.
    void begin(double gap_m) {
        const double cells = gap_m / plane_.resolution_m;
        std::vector<std::uint8_t> seeds(plane_.size(), 0);
        for (std::size_t i = 0; i < seeds.size(); ++i) {
            seeds[i] = gaps_[i] >= cells * cells && plan_.part_of_column[i] == kNoPart ? 1 : 0;
        }
        const CellComponents found = findComponents(plane_, seeds, 1);
        std::vector<std::size_t> front;
        for (const CellRun& run : found.runs) {
            for (int x = run.x_begin; x < run.x_end; ++x) {
                const std::size_t i = plane_.indexOf(x, run.y, 0);
                plan_.part_of_column[i] = plan_.parts + run.component;
                front.push_back(i);
            }
        }
        plan_.parts += static_cast<int>(found.cells.size());
        floodFrom(std::move(front), plane_, plan_.part_of_column,
                  [&](std::size_t from, std::size_t to) {
                      return walls_[to] == 0 && gaps_[to] <= gaps_[from];
                  });
    }

    /// Assigns the remaining columns without walls to the nearest part.
    void shareOut() {
        spread(plane_, plan_.part_of_column, [&](std::size_t to) { return walls_[to] == 0; });
    }

  private:
    const VoxelGrid& plane_;
    const std::vector<std::uint8_t>& walls_;
    FloorPlan& plan_;
    std::vector<std::uint16_t> gaps_;
};

}  // namespace

FloorPlan drawFloorPlan(const VoxelGrid& grid, const std::vector<std::uint8_t>& surfaces) {
    const std::vector<std::uint8_t> walls = findWalls(grid, surfaces);
    VoxelGrid plane = grid;
    plane.first[2] = 0;
    plane.count[2] = 1;
    FloorPlan plan;
    PartGrower grower(plane, walls, plan);
    for (const double gap_m : kPartGaps_m) grower.begin(gap_m);
    grower.shareOut();
    return plan;
}

}  // namespace dollytrack::planning
