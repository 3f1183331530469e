#pragma once

#include "engine/camera/sensor_params.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// The electronics of a colour camera, in linear light before tone curve and encoding, where 1 is
/// white: a pixel's electrons are Poisson distributed around light times white_e, reading them adds
/// normal noise, and the sum divided by white_e is the light again. So the variance is linear in
/// the light: light / white_e + (read_noise_e / white_e)^2. In place, 3 values a pixel.
void addPictureNoise(const SensorParams& params, int frame, std::span<float> light);

/// The tone curve of all pictures and sRGB, 3 bytes a pixel.
[[nodiscard]] std::vector<std::uint8_t> developedBytes(std::span<const float> light);

}  // namespace dollytrack::render
