#pragma once

#include "engine/scene/scene.h"

#include <array>
#include <vector>

namespace dollytrack {

/// Which sides an object rests on: of the points where it is lowest along x, -x, y, -y, z and -z,
/// the share that has another object's surface right below, from 0 to 1.
using SideSupport = std::array<float, 6>;

/// The index of a direction in a SideSupport.
constexpr std::size_t sideIndex(int axis, bool negative) {
    return 2 * static_cast<std::size_t>(axis) + (negative ? 1 : 0);
}

/// One entry for each object. Surfaces count as touching within `contact` of each other. Scenes of
/// more triangles than a second of work allows are not measured; all their entries are 0.
std::vector<SideSupport> measureSupport(const Scene& scene, double contact);

}  // namespace dollytrack
