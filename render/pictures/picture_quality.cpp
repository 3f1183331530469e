#include "render/pictures/picture_quality.h"

#include "engine/core/text_lists.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdlib>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr int kDarkLuma = 32;
constexpr int kWhiteLuma = 243;
constexpr int kTileSize = 8;      // px
constexpr int kTileContrast = 5;  // luma
constexpr int kTilePixels = kTileSize * kTileSize;

int lumaOf(const std::uint8_t* rgb) {
    return (54 * rgb[0] + 183 * rgb[1] + 19 * rgb[2] + 128) >> 8;
}

/// Sums of luma over the image's whole tiles, row by row.
struct Tiles {
    int across = 0;
    int down = 0;
    std::vector<int> sums;

    [[nodiscard]] bool differ(std::size_t a, std::size_t b) const {
        return std::abs(sums[a] - sums[b]) >= kTileContrast * kTilePixels;
    }
    [[nodiscard]] bool areFlat() const;
};

bool Tiles::areFlat() const {
    std::size_t pairs = 0;
    std::size_t differing = 0;
    for (int y = 0; y < down; ++y) {
        for (int x = 0; x < across; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * across + x;
            if (x + 1 < across) {
                ++pairs;
                differing += differ(i, i + 1) ? 1 : 0;
            }
            if (y + 1 < down) {
                ++pairs;
                differing += differ(i, i + static_cast<std::size_t>(across)) ? 1 : 0;
            }
        }
    }
    return 200 * differing < pairs;
}

}  // namespace

PictureQuality pictureQuality(int width, int height, std::span<const std::uint8_t> rgb) {
    Tiles tiles{width / kTileSize, height / kTileSize, {}};
    tiles.sums.assign(static_cast<std::size_t>(tiles.across) * tiles.down, 0);
    std::size_t dark = 0;
    std::size_t white = 0;
    const std::uint8_t* pixel = rgb.data();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, pixel += 3) {
            const int luma = lumaOf(pixel);
            dark += luma < kDarkLuma ? 1 : 0;
            white += luma > kWhiteLuma ? 1 : 0;
            const int column = x / kTileSize;
            const int row = y / kTileSize;
            if (column >= tiles.across || row >= tiles.down) continue;
            tiles.sums[static_cast<std::size_t>(row) * tiles.across + column] += luma;
        }
    }
    const std::size_t pixels = static_cast<std::size_t>(width) * height;
    if (pixels == 0) return PictureQuality::Usable;
    if (20 * dark >= 19 * pixels) return PictureQuality::Dark;
    if (20 * white >= 19 * pixels) return PictureQuality::White;
    return tiles.areFlat() ? PictureQuality::Flat : PictureQuality::Usable;
}

void PictureTally::add(int frame, PictureQuality quality) {
    ++pictures;
    if (quality == PictureQuality::Dark) dark.push_back(frame);
    if (quality == PictureQuality::White) white.push_back(frame);
    if (quality == PictureQuality::Flat) flat.push_back(frame);
}

std::string unusableText(const PictureTally& tally) {
    if (tally.unusable() == 0) return {};
    std::string kinds;
    for (const auto& [kind, frames] : {std::pair{PictureQuality::Dark, &tally.dark},
                                       {PictureQuality::White, &tally.white},
                                       {PictureQuality::Flat, &tally.flat}}) {
        if (frames->empty()) continue;
        kinds +=
            fmt::format("{} {} {} ({})", kinds.empty() ? ":" : ",", frames->size(),
                        kPictureQualities[static_cast<std::size_t>(kind)], frameRanges(*frames));
    }
    return fmt::format("{} of {} images {} unusable{}", tally.unusable(), tally.pictures,
                       tally.unusable() == 1 ? "is" : "are", kinds);
}

}  // namespace dollytrack::render
