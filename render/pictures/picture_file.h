#pragma once

#include "engine/io/files/guarded_folder.h"

#include <opencv2/core.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack::render {

/// Width and height that the header of a PNG file claims, px; small numbers where it is cut off.
/// Decoders take memory for them before they read a pixel.
[[nodiscard]] std::array<std::uint64_t, 2> pngSides(std::string_view png);

/// Reads an image like cv::imread() with the same flags, but only from a regular file of at most
/// 512 MiB, and of PNG files only those of at most 2^26 pixels; imread() would block on pipes, read
/// devices endlessly and make room for any size that a header claims. Returns an empty image if the
/// file is missing or cannot be decoded.
[[nodiscard]] cv::Mat readPictureFile(const std::filesystem::path& path, int flags);
/// The same for a file in a guarded folder.
[[nodiscard]] cv::Mat readPictureFile(const GuardedFolder& folder, const std::string& name,
                                      int flags);

}  // namespace dollytrack::render
