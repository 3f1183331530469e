#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack {

/// An image as a codec unpacks it: rows from the top without gaps; grey, grey and alpha, RGB or
/// RGBA.
struct DecodedPicture {
    int width = 0;
    int height = 0;
    int channels = 0;  // 1 to 4
    int bits = 8;      // of a channel; 16 are in the machine's byte order
    std::vector<std::uint8_t> data;
};

/// Allocates the pixel data for the size in a file's header; false if a side is invalid or there
/// are too many pixels.
bool makeRoom(std::int64_t width, std::int64_t height, int channels, int bits,
              DecodedPicture& picture);

using PictureBytes = std::span<const std::uint8_t>;

/// Unpacks PNG, JPEG, WebP, TIFF, TGA, BMP, PSD, GIF, PNM or HDR bytes, recognized by the first of
/// them. Empty if they cannot be decoded, or the image has more than kMostPicturePixels. A
/// truncated JPEG is filled with grey.
std::optional<DecodedPicture> unpackPicture(PictureBytes bytes);

/// One function per library. Call it only for bytes that begin like its format. Empty if the bytes
/// are not a complete image.
std::optional<DecodedPicture> unpackPng(PictureBytes bytes);
std::optional<DecodedPicture> unpackJpeg(PictureBytes bytes);
std::optional<DecodedPicture> unpackWebp(PictureBytes bytes);
std::optional<DecodedPicture> unpackTiff(PictureBytes bytes);
std::optional<DecodedPicture> unpackOther(PictureBytes bytes);  // TGA, BMP, PSD, GIF, PNM, HDR

}  // namespace dollytrack
