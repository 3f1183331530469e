#include "render/sensors/picture_noise.h"

#include "render/light/tone_curve.h"
#include "render/sensors/pixel_random.h"

#include <algorithm>

namespace dollytrack::render {

void addPictureNoise(const SensorParams& params, int frame, std::span<float> light) {
    if (params.white_e <= 0.0) return;
    // Separates these random numbers from other uses of the same pixel.
    constexpr std::uint64_t kPictureStream = 1ULL << 40U;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const PixelRandom random(static_cast<std::uint32_t>(params.sensor_seed), frame,
                                 kPictureStream + i);
        double electrons =
            random.poisson(params.white_e * std::max(0.0, static_cast<double>(light[i])), 0);
        if (params.read_noise_e > 0.0) electrons += params.read_noise_e * random.normal(2);
        light[i] = static_cast<float>(electrons / params.white_e);
    }
}

std::vector<std::uint8_t> developedBytes(std::span<const float> light) {
    std::vector<std::uint8_t> bytes(light.size());
    for (std::size_t i = 0; i + 2 < light.size(); i += 3) {
        const Eigen::Vector3f shown =
            toneCurve(Eigen::Vector3f(light[i], light[i + 1], light[i + 2]));
        for (std::size_t c = 0; c < 3; ++c) {
            bytes[i + c] = encodedByte(shown[static_cast<Eigen::Index>(c)]);
        }
    }
    return bytes;
}

}  // namespace dollytrack::render
