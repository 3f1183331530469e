#pragma once

#include "engine/scene/material.h"

#include <cstdint>
#include <span>

namespace dollytrack {

/// Images with more pixels are refused before anything is unpacked.
inline constexpr std::int64_t kMostPicturePixels = std::int64_t{1} << 26;

/// Decodes PNG, JPEG, WebP, TIFF, TGA, BMP, PSD, GIF, PNM or HDR bytes into 8-bit RGBA, rows from
/// the top; a longer side than `longest_side` is made smaller by area averaging, an `opaque`
/// image's alpha is set to 255. False when the bytes are no whole image, or it is too large.
bool decodePicture(std::span<const std::uint8_t> bytes, int longest_side, bool opaque,
                   Texture& texture);

}  // namespace dollytrack
