#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {

enum class JpegTables {
    Standard,   // the Huffman tables of the JPEG standard
    Optimized,  // Huffman tables computed for the image: smaller file, slower to write
};

/// Compresses an image, rows from the top, to a baseline JPEG with colour at half resolution.
/// `channels`: 1 (grey) or 3 (RGB, sRGB); `quality`: 1 .. 100. The same pixels give the same bytes.
/// `pixels` holds width * height * channels bytes. Fails if the size is wrong, or a side is over
/// 65,500 px.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeJpeg(
    int width, int height, int channels, int quality, std::span<const std::uint8_t> pixels,
    JpegTables tables = JpegTables::Standard);

}  // namespace dollytrack
