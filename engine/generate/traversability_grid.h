#pragma once

#include "engine/generate/upright_box.h"

#include <vector>

namespace dollytrack::generate {

/// A grid of the floor: the cells in which a camera with some clearance fits, and whether these
/// cells are connected.
class TraversabilityGrid {
  public:
    /// Size of the room, cm.
    TraversabilityGrid(double length, double width);

    /// Adds a point that must stay reachable, such as the floor before the door.
    void reach(const Eigen::Vector2d& point) { entrances_.push_back(point); }
    /// Whether the free cells would still be connected with one more box: all but small niches in
    /// one component, which covers a twelfth of the floor and contains all points of reach().
    [[nodiscard]] bool staysConnectedWith(const UprightBox& box) const;
    /// Marks the cells as blocked in which a camera would touch the box.
    void block(const UprightBox& box) { close(box, open_); }

  private:
    void close(const UprightBox& box, std::vector<bool>& open) const;
    [[nodiscard]] std::size_t cellAt(const Eigen::Vector2d& point) const;

    int columns_ = 0;
    int rows_ = 0;
    std::vector<bool> open_;
    std::vector<Eigen::Vector2d> entrances_;
};

}  // namespace dollytrack::generate
