#pragma once

#include "render/overlays/overlay.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// A rectangle on the outside of one or more blocks.
struct BoxFace {
    std::array<Eigen::Vector3f, 4> corners;  // (u0, v0), (u1, v0), (u0, v1), (u1, v1); with u x v
                                             // pointing out of the block
    std::array<std::uint16_t, 2> cells;      // blocks along u and v
    std::array<std::uint8_t, 4> rgba;        // shaded by where the face looks
};

/// The faces of blocks that can be seen. Where two blocks meet, none of the two faces is; equal
/// faces of equal colour side by side become one, which is a fraction of them for cells of a map.
/// Rounds to tenths of a millimetre.
[[nodiscard]] std::vector<BoxFace> visibleFaces(const std::vector<OverlayBox>& boxes);

}  // namespace dollytrack::render
