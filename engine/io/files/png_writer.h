#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

enum class PngFormat {
    Rgb8,    // 3 bytes a pixel, sRGB
    Rgb16,   // 6 bytes a pixel, in the machine's byte order
    Rgba8,   // 4 bytes a pixel, sRGB; the last is opacity
    Gray8,   // 1 byte a pixel
    Gray16,  // 2 bytes a pixel, in the machine's byte order
};

enum class PngEffort {
    Fast,      // quick to write, for datasets
    Smallest,  // slow to write, for web pages
};

/// Compresses an image, rows from the top, to a PNG. The same pixels give the same bytes.
/// `pixels` holds width * height * bytes-per-pixel bytes. Fails only when memory runs out.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodePng(int width, int height, PngFormat format,
                                                          std::span<const std::uint8_t> pixels,
                                                          PngEffort effort = PngEffort::Fast);

}  // namespace dollytrack
