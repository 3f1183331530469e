#pragma once

#include "engine/core/result.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Encodes an OpenEXR image with one 32-bit float channel "Y", row 0 at the top, ZIP compressed.
/// Equal values give equal bytes. Returns Failed if the library fails.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeExr(int width, int height,
                                                          std::span<const float> values);

/// The same with three 16-bit float channels "R", "G" and "B"; values are rounded.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeExr(int width, int height,
                                                          std::span<const Eigen::Vector3f> values);

/// Three 32-bit float channels "R", "G" and "B", for vectors.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeExrVectors(
    int width, int height, std::span<const Eigen::Vector3f> values);

/// Rounds each value to the nearest 16-bit float; larger ones become the largest.
[[nodiscard]] Eigen::Vector3f roundedToHalf(const Eigen::Vector3f& values);

}  // namespace dollytrack::render
