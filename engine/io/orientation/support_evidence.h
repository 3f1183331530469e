#pragma once

#include "engine/scene/scene.h"

#include <array>
#include <vector>

namespace dollytrack {

/// How well an object is supported by others, for each assumed up direction x, -x, y, -y, z, -z:
/// the share of its four outermost lowest points that touch another object's surface, 0..1.
using SideSupport = std::array<float, 6>;

/// The index of a direction in a SideSupport.
constexpr std::size_t sideIndex(int axis, bool negative) {
    return 2 * static_cast<std::size_t>(axis) + (negative ? 1 : 0);
}

/// The support of each object, in the scene's order. `contact` is the largest distance of touching
/// surfaces, in the scene's unit. All values are 0 for fewer than two objects, and for more than 5
/// million triangles, which would take too long.
std::vector<SideSupport> measureSupport(const Scene& scene, double contact);

}  // namespace dollytrack
