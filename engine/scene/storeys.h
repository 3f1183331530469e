#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack {

/// A floor of the building. Heights in the world frame, m.
struct FloorLevel {
    double underside_m = 0.0;  // of its slab; equal to top_m if it has no thickness
    double top_m = 0.0;
};

/// The floors of the building from the lowest up: large horizontal surfaces of objects with the
/// class floor.
[[nodiscard]] std::vector<FloorLevel> labelledFloors(const Scene& scene);

/// As labelledFloors(), but from all parts of the building except ceilings, because many files have
/// floors and walls in one mesh. A surface counts if 1 m above it lies within the height of one of
/// `rooms`, the boxes of places where a camera can be.
[[nodiscard]] std::vector<FloorLevel> floorsBelow(const Scene& scene,
                                                  std::span<const Eigen::AlignedBox3d> rooms);

/// Height of the lowest large horizontal surface of the building, whatever its class except
/// ceiling; without one, the lowest height of the room bounds.
[[nodiscard]] double lowestFloor(const Scene& scene);

}  // namespace dollytrack
