#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// Whether the objects in an image can be told apart, and if not, why. Luma is that of the sRGB
/// bytes, in steps of 255: (54 R + 183 G + 19 B + 128) / 256, rounded down. An image is
/// - dark if at least 95 % of its pixels have a luma below 32,
/// - white if at least 95 % have a luma above 243,
/// - flat if fewer than 0.5 % of the pairs of neighbouring tiles of 8 x 8 px differ by 5 or more in
///   mean luma. Only whole tiles count; an image smaller than two tiles is never flat.
enum class PictureQuality : std::uint8_t { Usable, Dark, White, Flat };

/// Names in datasets, in the order of PictureQuality.
inline constexpr std::array<std::string_view, 4> kPictureQualities = {"usable", "dark", "white",
                                                                      "flat"};

/// Classifies an sRGB image, 3 bytes per pixel, row 0 at the top.
[[nodiscard]] PictureQuality pictureQuality(int width, int height,
                                            std::span<const std::uint8_t> rgb);

/// The indices of the frames of a dataset whose images are unusable.
struct PictureTally {
    int pictures = 0;  // number of images classified; 0 without the modality rgb
    std::vector<int> dark;
    std::vector<int> white;
    std::vector<int> flat;

    void add(int frame, PictureQuality quality);
    [[nodiscard]] int unusable() const {
        return static_cast<int>(dark.size() + white.size() + flat.size());
    }
};

/// "3 of 60 images are unusable: 2 dark (frames 4-5), 1 flat (frame 17)"; empty if none is.
[[nodiscard]] std::string unusableText(const PictureTally& tally);

}  // namespace dollytrack::render
