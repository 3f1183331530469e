#pragma once

#include <cmath>

namespace dollytrack {

/// Converts an sRGB encoded value to a linear one, both 0..1.
inline float linearFromSrgb(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

/// Converts a linear value to an sRGB encoded one, both 0..1.
inline float srgbFromLinear(float linear) {
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

}  // namespace dollytrack
