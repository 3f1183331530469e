#pragma once

#include "engine/io/homes/home.h"

#include <vector>

namespace dollytrack::homes {

/// A straight segment of a wall, in the plan. Straight walls have one, round walls several.
struct WallSegment {
    Eigen::Vector2d left_start, left_end, right_start, right_end;
    double from = 0.0;  // its interval of the wall's length, 0..1
    double to = 1.0;

    /// Unit vector from start to end, and the one to the left of it.
    [[nodiscard]] Eigen::Vector2d along() const;
    [[nodiscard]] Eigen::Vector2d leftward() const;
};

/// The segments of each wall. Walls that name each other as neighbours share a mitred corner,
/// unless it would extend farther than twice the thickness of the thicker wall. A segment of a
/// round wall covers at most 7.5 degrees. Walls of length 0 have no segments.
std::vector<std::vector<WallSegment>> wallOutlines(const std::vector<HomeWall>& walls);

}  // namespace dollytrack::homes
