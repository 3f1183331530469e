#pragma once

#include "engine/io/files/guarded_folder.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>

namespace dollytrack::render {

/// Reads an image like cv::imread() with the same flags, but only from a regular file of at most
/// 512 MiB; imread() would block on pipes and read devices endlessly. Returns an empty image if the
/// file is missing or cannot be decoded.
[[nodiscard]] cv::Mat readPictureFile(const std::filesystem::path& path, int flags);
/// The same for a file in a guarded folder.
[[nodiscard]] cv::Mat readPictureFile(const io::GuardedFolder& folder, const std::string& name,
                                      int flags);

}  // namespace dollytrack::render
