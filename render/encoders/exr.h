#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// Encodes an OpenEXR image with one 32-bit float channel "Y", row 0 at the top, ZIP compressed.
/// Equal values give equal bytes. Returns Failed if the library fails.
[[nodiscard]] Result<std::vector<std::uint8_t>> encodeExr(int width, int height,
                                                          std::span<const float> values);

/// An image of one or three channels as floats, row 0 at the top.
struct DecodedExr {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<float> values;  // channels together, pixel by pixel
};

/// Decodes an OpenEXR image with the channel "Y", or else R, G and B. Returns BadInput if the bytes
/// are damaged or no such image, or it has more than 2^26 pixels.
[[nodiscard]] Result<DecodedExr> decodeExr(std::string_view bytes);

}  // namespace dollytrack::render
