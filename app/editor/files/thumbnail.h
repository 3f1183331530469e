#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace dollytrack::editor {

/// A small 8-bit RGBA picture of a project, rows from the top.
struct Thumbnail {
    static constexpr int kWidth = 192;
    static constexpr int kHeight = 120;
    std::vector<std::uint8_t> rgba;  // empty: none
};

/// The middle of an RGBA image in the thumbnail's proportions, scaled down by area averaging and
/// opaque. No picture if the image is smaller than a thumbnail.
[[nodiscard]] Thumbnail thumbnailOf(int width, int height, std::span<const std::uint8_t> rgba);

/// The file in the folder that holds the picture of a project; the name depends on the project's
/// path.
[[nodiscard]] std::filesystem::path thumbnailFile(const std::filesystem::path& folder,
                                                  const std::filesystem::path& project);

/// Writes the picture as PNG and creates the folder; removes the oldest pictures of a folder with
/// more than 40.
[[nodiscard]] Status writeThumbnail(const std::filesystem::path& file, const Thumbnail& picture);

/// Reads a picture. None for a missing file, for one of more than 1 MiB and for anything but a PNG
/// of the thumbnail's size; the size is checked before anything is unpacked.
[[nodiscard]] Thumbnail readThumbnail(const std::filesystem::path& file);

}  // namespace dollytrack::editor
