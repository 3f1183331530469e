#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace dollytrack::render {

// From linear light to the bytes of an image, as in assets/shaders/light.frag.

/// Tone curve: identity up to 0.55, then a smooth roll-off towards 1, so that lamps do not clip.
/// Linear input and output, 1 is white.
[[nodiscard]] Eigen::Vector3f toneCurve(const Eigen::Vector3f& linear);

/// Inverse of toneCurve(). Values near 1 map to a large finite value.
[[nodiscard]] Eigen::Vector3f inverseToneCurve(const Eigen::Vector3f& shown);

/// sRGB encoding of a linear value, 0..1, as a byte.
[[nodiscard]] std::uint8_t encodedByte(float linear);

/// Linear value of an sRGB colour, 0..1.
[[nodiscard]] Eigen::Vector3f decoded(const Eigen::Vector3f& srgb);

/// sRGB colour of the sky where a ray hits nothing. `rise` is the sine of the ray's elevation above
/// the horizon. `grey` desaturates it, from 0 (none) to 1 (grey).
[[nodiscard]] Eigen::Vector3f skyBackdrop(float rise, float grey = 0.0F);

}  // namespace dollytrack::render
