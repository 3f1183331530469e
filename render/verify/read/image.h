#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dollytrack::verify {

/// An image as stored, row 0 at the top, channels in the order red, green, blue.
template <class T>
struct Image {
    int width = 0;
    int height = 0;
    int channels = 1;
    std::vector<T> values;

    [[nodiscard]] const T* pixel(int x, int y) const {
        return values.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x)) *
                                   static_cast<std::size_t>(channels);
    }
    [[nodiscard]] T at(int x, int y) const { return *pixel(x, y); }
    [[nodiscard]] bool holds(int x, int y) const {
        return x >= 0 && y >= 0 && x < width && y < height;
    }
};

/// The 8-bit sRGB value of linear light, clamped to 0..1.
[[nodiscard]] inline int encodedSrgb(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255.0 * s));
}

}  // namespace dollytrack::verify
