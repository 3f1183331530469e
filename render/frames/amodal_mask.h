#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Amodal mask: the pixels that an object would cover if nothing stood in front of it.
struct RenderedAmodalMask {
    int object_id = 0;
    int x0 = 0;  // px, rectangle of the image that contains the mask
    int y0 = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> inside;  // by pixel of the rectangle, row 0 at the top: 0 or 255

    [[nodiscard]] bool covers(int x, int y) const {
        return x >= x0 && y >= y0 && x < x0 + width && y < y0 + height &&
               inside[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x - x0)] != 0;
    }
};

}  // namespace dollytrack::render
