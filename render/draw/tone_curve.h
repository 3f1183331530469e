#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace dollytrack::render {

// From light to the bytes of a picture; as assets/shaders/light.frag does it.

/// Leaves dark and middle tones alone and rolls off towards white, so that lamps do not clip.
/// Linear in and out, 1 is white.
[[nodiscard]] Eigen::Vector3f toneCurve(const Eigen::Vector3f& linear);

/// What becomes `shown`; of full white something very bright.
[[nodiscard]] Eigen::Vector3f inverseToneCurve(const Eigen::Vector3f& shown);

/// sRGB's encoding, 0..1 to 0..255.
[[nodiscard]] std::uint8_t encodedByte(float linear);

/// Linear of sRGB's encoding, 0..1.
[[nodiscard]] Eigen::Vector3f decoded(const Eigen::Vector3f& srgb);

/// sRGB where a view meets nothing; `rise` is the sine of the way's angle above the horizon. Its
/// colour goes with `grey`, and is gone at 1.
[[nodiscard]] Eigen::Vector3f skyBackdrop(float rise, float grey = 0.0F);

}  // namespace dollytrack::render
