#pragma once

#include "planning/free_space/enclosure_classifier.h"

#include <cstdint>
#include <vector>

namespace dollytrack::planning {

/// Classifies the cells without surface as inside or outside the building.
///
/// From its walls, floor and ceiling (see castEnclosureRays) a cell is inside for certain or
/// possibly: possibly before a missing wall or at a window without glass, but also in the notch of
/// an L-shaped house. The cells of each part of the floor plan are counted at each height (see
/// EnclosureClassifier), so that a room is inside as a whole. A part with much furniture is inside
/// even with few walls.
class Enclosure {
  public:
    Enclosure(const EnclosureInput& seen, const FloorPlan& plan, EnclosureRule rule);

    /// Incremental update of `other`, made for `before` with the same floor plan. `changed` are
    /// disjoint boxes that hold all cells whose surface or surroundings differ. Gives the same
    /// result as the other constructor.
    Enclosure(const Enclosure& other, const EnclosureInput& before, const EnclosureInput& now,
              const FloorPlan& plan, const std::vector<CellBox>& changed);

    /// By cell: 1 inside, 0 not.
    [[nodiscard]] const std::vector<std::uint8_t>& cells() const { return cells_; }

  private:
    void fill(const EnclosureInput& seen, const FloorPlan& plan);

    EnclosureRule rule_;
    EnclosureClassifier classifier_;
    std::vector<std::uint8_t> cells_;
};

}  // namespace dollytrack::planning
