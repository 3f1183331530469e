#pragma once

#include "planning/free_space/election.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Which cells without surface are inside the building.
///
/// By what is seen from it (lookAround) a cell may be inside for certain, or perhaps: before a
/// missing wall, at a window without glass, but also in the notch of an L-shaped house. The cells
/// vote in the parts of the floor plan, height by height, so that a room is inside as a whole. A
/// part full of furniture is inside even where it has few walls.
class Enclosure {
  public:
    Enclosure(const SeenCells& seen, const FloorPlan& plan, EnclosureRule rule);

    /// The same from that of other surfaces, which had the same plan: these boxes, which share no
    /// cell, hold all that was seen otherwise.
    Enclosure(const Enclosure& other, const SeenCells& before, const SeenCells& now,
              const FloorPlan& plan, const std::vector<CellBox>& changed);

    /// 1 inside, 0 not.
    [[nodiscard]] const std::vector<std::uint8_t>& cells() const { return cells_; }

  private:
    void fill(const SeenCells& seen, const FloorPlan& plan);

    EnclosureRule rule_;
    Election election_;
    std::vector<std::uint8_t> cells_;
};

}  // namespace dollytrack::planning
