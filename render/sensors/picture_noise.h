#pragma once

#include "engine/camera/sensor_params.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Sensor noise of a colour camera in linear light, 1 is white, before tone curve and encoding.
/// Electrons are Poisson distributed with mean light * white_e; reading adds Gaussian noise;
/// dividing by white_e gives light again. The variance is light / white_e + (read_noise_e /
/// white_e)^2. Works in place, 3 values per pixel. Does nothing if white_e is 0.
void addPictureNoise(const SensorParams& params, int frame, std::span<float> light);

/// Applies the tone curve and sRGB encoding, 3 bytes per pixel.
[[nodiscard]] std::vector<std::uint8_t> developedBytes(std::span<const float> light);

}  // namespace dollytrack::render
