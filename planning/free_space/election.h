#pragma once

#include "planning/free_space/cell_box.h"
#include "planning/free_space/floor_plan.h"
#include "planning/free_space/voxel_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// How much a place must be surrounded to count as inside the building.
enum class EnclosureRule {
    Walls,      // walls nearly all round, or half round between floor and ceiling
    FewWalls,   // half round, or less over a floor of its own: doll's houses, cut-away rooms
    FloorOnly,  // anything above a floor
};

/// What the map knows before it tells inside from outside. References must outlive it.
struct SeenCells {
    const VoxelGrid& grid;
    const std::vector<std::uint8_t>& surfaces;  // CellSurface sets
    const std::vector<std::uint8_t>& sight;     // see lookAround()

    /// Calls visit(index) for the cells of one slice of the box that are air of the room.
    template <class Visit>
    void visitAir(const CellBox& box, int z, Visit&& visit) const {
        if (z < grid.room_begin[2] || z >= grid.room_end[2]) return;
        const int x_begin = std::max(box.begin[0], grid.room_begin[0]);
        const int x_end = std::min(box.end[0], grid.room_end[0]);
        const int y_end = std::min(box.end[1], grid.room_end[1]);
        for (int y = std::max(box.begin[1], grid.room_begin[1]); y < y_end; ++y) {
            const std::size_t row = grid.rowOf(y, z);
            for (int x = x_begin; x < x_end; ++x) {
                const std::size_t i = row + static_cast<std::size_t>(x);
                if (surfaces[i] == 0) visit(i);
            }
        }
    }
};

/// What the cells of each part of the floor plan vote for, height by height, and what follows from
/// it.
class Election {
  public:
    Election(const SeenCells& seen, const FloorPlan& plan, EnclosureRule rule);

    /// Counts the votes again that are cast in these boxes, which share no cell; nothing else
    /// differs, and the plan is the same. False, and of no use any more, where all votes would have
    /// to be counted again.
    bool recount(const SeenCells& before, const SeenCells& now, const FloorPlan& plan,
                 const std::vector<CellBox>& boxes);

    /// Whether the building is roofed: a niche of the facade with walls on three sides is then not
    /// inside.
    [[nodiscard]] bool isRoofed() const { return roofed_; }
    /// For every part whether it is inside, one entry a height.
    [[nodiscard]] const std::vector<std::vector<std::uint8_t>>& inside() const { return inside_; }

  private:
    /// Of one part at one height.
    struct Votes {
        std::int64_t air = 0;
        std::int64_t possible = 0;  // certain ones among them
        std::int64_t certain = 0;
        std::int64_t covered = 0;  // with floor below or ceiling above
        std::int64_t hits = 0;
    };

    void countRoof(const SeenCells& seen, const CellBox& box, int sign);
    void countVotes(const SeenCells& seen, const FloorPlan& plan, const CellBox& box, int sign);
    void findThings(const SeenCells& seen, const CellBox& box);
    [[nodiscard]] bool judgeRoof() const;
    [[nodiscard]] std::vector<std::uint8_t> findFurnished(const VoxelGrid& grid,
                                                          const FloorPlan& plan) const;
    void decide(const VoxelGrid& grid, const FloorPlan& plan);

    EnclosureRule rule_;
    bool roofed_ = false;
    std::vector<std::array<std::int64_t, 2>> roof_;  // by height: certain cells, and with both
                                                     // floor and ceiling
    std::vector<std::vector<Votes>> votes_;          // by height, then part
    std::vector<std::uint8_t> thing_;                // columns that hold furniture
    std::vector<std::vector<std::uint8_t>> inside_;
};

}  // namespace dollytrack::planning
