#pragma once

#include "engine/io/files/guarded_folder.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>

namespace dollytrack::render {

/// Reads an image as it is stored, in the order grey or red, green, blue (and alpha), 8 or 16 bits
/// a channel. Only regular files of at most 512 MiB and 2^26 pixels are read. Returns an empty
/// image if the file is missing or cannot be decoded.
[[nodiscard]] cv::Mat readPictureFile(const std::filesystem::path& path);
/// The same for a file in a guarded folder.
[[nodiscard]] cv::Mat readPictureFile(const GuardedFolder& folder, const std::string& name);

}  // namespace dollytrack::render
