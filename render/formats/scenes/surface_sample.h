#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// A point of a scene's surface with its colour.
struct SurfacePoint {
    Eigen::Vector3d position;
    std::array<std::uint8_t, 3> color = {0, 0, 0};  // 8-bit sRGB, unlit
};

/// Points spread evenly over all surfaces; the same for the same seed.
[[nodiscard]] std::vector<SurfacePoint> sampleSurface(const Scene& scene, int count,
                                                      std::uint64_t seed);

}  // namespace dollytrack::render
