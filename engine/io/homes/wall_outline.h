#pragma once

#include "engine/io/homes/home.h"

#include <vector>

namespace dollytrack::homes {

/// A straight stretch of a wall from above, in the plan: a straight wall is one, a round one many.
struct WallStretch {
    Eigen::Vector2d left_start, left_end, right_start, right_end;
    double from = 0.0;  // its share of the wall's length, 0..1
    double to = 1.0;

    /// Unit vector from start to end, and the one to the left of it.
    [[nodiscard]] Eigen::Vector2d along() const;
    [[nodiscard]] Eigen::Vector2d leftward() const;
};

/// The outline of each wall. Walls that name each other as neighbours share a mitred corner, as
/// far as that does not reach further than twice the thicker one; round walls turn by at most
/// 7.5 degrees a stretch. A wall without length has none.
std::vector<std::vector<WallStretch>> wallOutlines(const std::vector<HomeWall>& walls);

}  // namespace dollytrack::homes
