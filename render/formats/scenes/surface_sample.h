#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// A point on a scene's surface, world frame, with its colour.
struct ColoredPoint {
    Eigen::Vector3d position;
    std::array<std::uint8_t, 3> color = {0, 0, 0};  // 8-bit sRGB, unlit
};

/// `count` points uniformly distributed over all surfaces, reproducible by `seed`. Empty if the
/// scene has no area.
[[nodiscard]] std::vector<ColoredPoint> sampleSurface(const Scene& scene, int count,
                                                      std::uint64_t seed);

}  // namespace dollytrack::render
