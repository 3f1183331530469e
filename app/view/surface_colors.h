#pragma once

#include "engine/scene/scene.h"

#include <array>
#include <cstdint>

namespace dollytrack::view {

/// The mean colour of a triangle, linear: its material's base colour and emission, with their
/// textures averaged over a few points of it.
[[nodiscard]] Eigen::Vector3f triangleColor(const Scene& scene, std::uint32_t triangle);

/// Whether one mostly looks through the triangle, as through glass.
[[nodiscard]] bool isClear(const Scene& scene, std::uint32_t triangle);

/// A linear colour as sRGB bytes.
[[nodiscard]] std::array<std::uint8_t, 3> srgbBytes(const Eigen::Vector3f& linear);

}  // namespace dollytrack::view
