#pragma once

#include "engine/scene/scene.h"

#include <array>
#include <vector>

namespace dollytrack {

/// How well an object rests on others, for each assumed upward direction x, -x, y, -y, z, -z: the
/// share of its four outermost lowest points that touch another object's surface, 0 to 1.
using SideSupport = std::array<float, 6>;

/// The index of a direction in a SideSupport.
constexpr std::size_t sideIndex(int axis, bool negative) {
    return 2 * static_cast<std::size_t>(axis) + (negative ? 1 : 0);
}

/// One entry per object, in the scene's order. `contact` is the distance within which surfaces
/// touch, in the scene's unit. All entries are 0 for fewer than two objects, and for more than
/// 5 million triangles, which would take too long.
std::vector<SideSupport> measureSupport(const Scene& scene, double contact);

}  // namespace dollytrack
