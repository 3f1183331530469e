#include "render/sensors/pixel_random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::render {

double PixelRandom::normal(std::uint32_t place) const {
    return std::sqrt(-2.0 * std::log(uniform(place))) *
           std::cos(2.0 * std::numbers::pi * uniform(place + 1));
}

double PixelRandom::poisson(double mean, std::uint32_t place) const {
    if (!(mean > 0.0)) return 0.0;
    if (mean >= 64.0) {
        return std::max(0.0, std::round(mean + std::sqrt(mean) * normal(place)));
    }
    // Inverts the cumulative distribution by summation, which needs few steps beyond the mean.
    double left = uniform(place);
    double share = std::exp(-mean);
    int count = 0;
    while (left > share && count < 256) {
        left -= share;
        share *= mean / ++count;
    }
    return count;
}

}  // namespace dollytrack::render
