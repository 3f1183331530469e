#pragma once

#include "render/verify/read/image_files.h"

#include <array>
#include <map>

namespace dollytrack::verify {

/// Pixel count and bounds of one object in an id image.
struct ObjectPixels {
    int count = 0;
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;  // bounds, inclusive

    /// x, y, width, height; [0,0,1,1] is the first pixel.
    [[nodiscard]] std::array<double, 4> box() const {
        return {double(x0), double(y0), double(x1 - x0 + 1), double(y1 - y0 + 1)};
    }
};

/// By id, without 0.
std::map<int, ObjectPixels> objectPixels(const Image16& ids);

}  // namespace dollytrack::verify
