#include "render/sensors/picture_noise.h"

#include "render/sensors/pixel_random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dollytrack::render::picture_noise_test {
namespace {

constexpr std::size_t kValues = 200'000;

struct Moments {
    double mean = 0.0;
    double variance = 0.0;
};

template <class Get>
Moments momentsOf(std::size_t count, const Get& get) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double value = get(i);
        sum += value;
        squares += value * value;
    }
    const double n = static_cast<double>(count);
    return {sum / n, squares / n - sum * sum / n / n};
}

SensorParams noisy(double white_e, double read_e) {
    SensorParams params;
    params.white_e = white_e;
    params.read_noise_e = read_e;
    return params;
}

Moments ofGrey(const SensorParams& params, float light) {
    std::vector<float> values(kValues, light);
    addPictureNoise(params, 4, values);
    return momentsOf(kValues, [&](std::size_t i) { return values[i]; });
}

TEST(PixelRandom, CountsArePoissonDistributed) {
    for (const double mean : {0.3, 5.0, 63.0, 65.0, 900.0}) {
        const Moments found = momentsOf(
            kValues, [&](std::size_t i) { return PixelRandom(1, 0, i).poisson(mean, 0); });
        const double error = std::sqrt(mean / kValues);
        EXPECT_NEAR(found.mean, mean, 5 * error);
        EXPECT_NEAR(found.variance / mean, 1.0, 0.02) << mean;
    }
    // The share of zeros is exp(-mean), unlike in a normal distribution.
    const Moments none = momentsOf(kValues, [&](std::size_t i) {
        return PixelRandom(1, 0, i).poisson(0.7, 0) == 0.0 ? 1.0 : 0.0;
    });
    EXPECT_NEAR(none.mean, std::exp(-0.7), 0.005);
}

// The photon transfer curve, which laboratories use to measure gain and read noise.
TEST(PictureNoise, VarianceIsLinearInTheLight) {
    const SensorParams params = noisy(2000.0, 12.0);
    for (const float light : {0.0F, 0.01F, 0.1F, 0.5F, 1.0F, 3.0F}) {
        const Moments found = ofGrey(params, light);
        const double expected = light / 2000.0 + std::pow(12.0 / 2000.0, 2);
        EXPECT_NEAR(found.mean, light, 5 * std::sqrt(expected / kValues));
        EXPECT_NEAR(found.variance / expected, 1.0, 0.03) << light;
    }
    EXPECT_GT(ofGrey(noisy(500.0, 0.0), 0.5F).variance,
              3.5 * ofGrey(noisy(2000.0, 0.0), 0.5F).variance)
        << "a fourth of the light is four times the variance";
}

TEST(PictureNoise, NoneIsNone) {
    EXPECT_EQ(ofGrey(noisy(0.0, 50.0), 0.25F).variance, 0.0);
    EXPECT_EQ(ofGrey(noisy(0.0, 50.0), 0.25F).mean, 0.25);
}

TEST(PictureNoise, DependsOnSeedFrameAndPixelAlone) {
    const auto noise = [](int seed, int frame) {
        SensorParams params = noisy(1000.0, 5.0);
        params.sensor_seed = seed;
        std::vector<float> values(3000, 0.5F);
        addPictureNoise(params, frame, values);
        return values;
    };
    EXPECT_EQ(noise(1, 2), noise(1, 2));
    EXPECT_NE(noise(1, 2), noise(2, 2));
    EXPECT_NE(noise(1, 2), noise(1, 3));
    // Noise is independent between neighbouring pixels and between frames.
    const std::vector<float> a = noise(1, 2), b = noise(1, 3);
    double beside = 0.0, after = 0.0, square = 0.0;
    for (std::size_t i = 0; i + 3 < a.size(); ++i) {
        beside += (a[i] - 0.5) * (a[i + 3] - 0.5);
        after += (a[i] - 0.5) * (b[i] - 0.5);
        square += (a[i] - 0.5) * (a[i] - 0.5);
    }
    EXPECT_LT(std::abs(beside / square), 0.08);
    EXPECT_LT(std::abs(after / square), 0.08);
}

}  // namespace
}  // namespace dollytrack::render::picture_noise_test
