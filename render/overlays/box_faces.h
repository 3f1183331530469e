#pragma once

#include "render/overlays/overlay.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// A rectangle on the outside of one or more boxes.
struct BoxFace {
    std::array<Eigen::Vector3f, 4> corners;  // (u0, v0), (u1, v0), (u0, v1), (u1, v1); u x v points
                                             // out of the box
    std::array<std::uint16_t, 2> cells;      // number of boxes along u and v
    std::array<std::uint8_t, 4> rgba;        // shaded by the face's direction
};

/// The visible faces of boxes. Among boxes with yaw 0, equal faces of two touching boxes are
/// dropped and neighbouring faces of equal size and colour are merged, which leaves a fraction of
/// the faces of a grid map. Sizes and positions are rounded to 0.1 mm.
[[nodiscard]] std::vector<BoxFace> visibleFaces(const std::vector<OverlayBox>& boxes);

}  // namespace dollytrack::render
