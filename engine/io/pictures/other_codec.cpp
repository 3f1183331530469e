#include "engine/io/pictures/codecs.h"

#include <algorithm>
#include <limits>
#include <memory>

#define STBI_NO_STDIO
#define STBI_NO_PNG
#define STBI_NO_JPEG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace dollytrack {
namespace {

/// Whether an HDR file, whose size stb_image has read, has all rows. stb_image 2.27 does not end at
/// a file that ends within a run.
bool hasAllRows(PictureBytes bytes, int width, int height) {
    std::size_t at = 0;
    const auto passLine = [&] {  // returns its length
        const std::size_t begin = at;
        while (at < bytes.size() && bytes[at] != '\n') ++at;
        const std::size_t length = at - begin;
        at = std::min(at + 1, bytes.size());
        return length;
    };
    while (passLine() > 0) {
    }
    passLine();  // the size
    const auto header = bytes.first(at);
    if (std::ranges::find(header, 0) != header.end())
        return false;  // stb_image ends the line there
    constexpr int kLeastPacked = 8;
    constexpr int kMostPacked = 32767;
    const auto hasPlainPixels = [&] {
        return bytes.size() - at >= 4 * static_cast<std::size_t>(width) * height;
    };
    if (width < kLeastPacked || width > kMostPacked) return hasPlainPixels();
    for (int row = 0; row < height; ++row) {
        constexpr std::size_t kRowHead = 4;
        if (bytes.size() - at < kRowHead) return false;
        const bool packed = bytes[at] == 2 && bytes[at + 1] == 2 && bytes[at + 2] < 128;
        if (!packed) return hasPlainPixels();
        at += kRowHead;
        for (int left = 4 * width; left > 0;) {
            if (at >= bytes.size()) return false;
            const int count = bytes[at];
            const int pixels = count > 128 ? count - 128 : count;
            at += 1 + static_cast<std::size_t>(count > 128 ? 1 : count);
            left -= pixels;
        }
    }
    return at <= bytes.size();
}

}  // namespace

std::optional<DecodedPicture> unpackOther(PictureBytes bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return std::nullopt;
    }
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    DecodedPicture picture;
    if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0 ||
        !makeRoom(width, height, channels, 8, picture)) {
        return std::nullopt;
    }
    if (stbi_is_hdr_from_memory(bytes.data(), size) != 0 && !hasAllRows(bytes, width, height)) {
        return std::nullopt;
    }
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, picture.channels),
        &stbi_image_free);
    if (!pixels || width != picture.width || height != picture.height) return std::nullopt;
    std::copy_n(pixels.get(), picture.data.size(), picture.data.begin());
    return picture;
}

}  // namespace dollytrack
