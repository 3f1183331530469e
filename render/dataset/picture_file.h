#pragma once

#include "engine/io/files/guarded_folder.h"

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>

namespace dollytrack::render {

/// Reads a picture as cv::imread() does with the same flags, but only from an ordinary file of at
/// most 512 MiB: imread() waits for pipes and reads devices without end. Empty where there is none
/// or it cannot be decoded.
[[nodiscard]] cv::Mat readPictureFile(const std::filesystem::path& path, int flags);
/// The same, of a file in a guarded folder.
[[nodiscard]] cv::Mat readPictureFile(const io::GuardedFolder& folder, const std::string& name,
                                      int flags);

}  // namespace dollytrack::render
