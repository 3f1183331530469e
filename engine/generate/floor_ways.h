#pragma once

#include "engine/generate/upright_box.h"

#include <vector>

namespace dollytrack::generate {

/// The floor as a grid: where a camera with some room around it could be, and whether all of that
/// is joined.
class FloorWays {
  public:
    /// Sizes of the room, cm.
    FloorWays(double length, double width);

    /// A point that has to be reached: where one comes in.
    void reach(const Eigen::Vector2d& point) { entrances_.push_back(point); }
    /// Whether with one box more everything open is still one part, but for small niches, and
    /// large enough, and holds the entrances.
    [[nodiscard]] bool stayJoinedWith(const UprightBox& box) const;
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
