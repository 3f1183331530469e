#pragma once

#include "planning/free_space/cell_box.h"
#include "planning/free_space/floor_plan.h"
#include "planning/free_space/voxel_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Rules for which cells are certainly inside the building, from strict to lax. Cells with fewer
/// walls may be possibly inside.
enum class EnclosureRule {
    Walls,      // walls in 12 of 16 directions (if not roofed), or in 8 between floor and ceiling
    FewWalls,   // walls in 8 directions, or in 5 above a floor: doll's houses, cut-away rooms
    FloorOnly,  // any cell above a floor
};

/// Input of the enclosure classification. Keeps references.
struct EnclosureInput {
    const VoxelGrid& grid;
    const std::vector<std::uint8_t>& surfaces;  // CellSurface bits, by cell
    const std::vector<std::uint8_t>& ray_bits;  // result of castEnclosureRays(), by cell

    /// Calls visit(index) for the cells without surface in one slice of the box, within the room
    /// bounds.
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

/// Classifies each part of the floor plan as inside or outside, separately at each height, by
/// counts of its cells.
class EnclosureClassifier {
  public:
    EnclosureClassifier(const EnclosureInput& seen, const FloorPlan& plan, EnclosureRule rule);

    /// Incremental update: recounts the cells in `boxes`, which must be disjoint and hold all
    /// differences between `before` and `now`. The floor plan must be the same. Returns false if
    /// the change is too large for an incremental update; the object must then be rebuilt.
    bool recount(const EnclosureInput& before, const EnclosureInput& now, const FloorPlan& plan,
                 const std::vector<CellBox>& boxes);

    /// Whether the building is roofed: at least 70 % of the cells certainly inside have both floor
    /// and ceiling. Cells without a ceiling are then not inside, for example a niche of the facade.
    [[nodiscard]] bool isRoofed() const { return roofed_; }
    /// By part, then height: 1 if inside.
    [[nodiscard]] const std::vector<std::vector<std::uint8_t>>& inside() const { return inside_; }

  private:
    /// Counts of the cells of one part at one height.
    struct EnclosureCounts {
        std::int64_t air = 0;
        std::int64_t possible = 0;  // possibly or certainly inside
        std::int64_t certain = 0;
        std::int64_t covered = 0;  // with a floor below or a ceiling above
        std::int64_t hits = 0;
    };

    void countRoof(const EnclosureInput& seen, const CellBox& box, int sign);
    void countCells(const EnclosureInput& seen, const FloorPlan& plan, const CellBox& box,
                    int sign);
    void findFurnitureColumns(const EnclosureInput& seen, const CellBox& box);
    [[nodiscard]] bool hasRoof() const;
    [[nodiscard]] std::vector<std::uint8_t> findFurnished(const VoxelGrid& grid,
                                                          const FloorPlan& plan) const;
    void decide(const VoxelGrid& grid, const FloorPlan& plan);

    EnclosureRule rule_;
    bool roofed_ = false;
    std::vector<std::array<std::int64_t, 2>> roof_;  // by height: cells certainly inside, and those
                                                     // of them with floor and ceiling
    std::vector<std::vector<EnclosureCounts>> counts_;  // by height, then part
    std::vector<std::uint8_t> furniture_;               // by column: 1 if it holds furniture
    std::vector<std::vector<std::uint8_t>> inside_;
};

}  // namespace dollytrack::planning
