#pragma once

#include "engine/core/result.h"
#include "render/verify/read/image_files.h"

#include <filesystem>
#include <string>

namespace dollytrack::verify {

/// Reads images from NumPy .npy files: rows x columns or rows x columns x channels, in C order.
/// An array of one dimension is one row.
/// Fails if the file's type or number of channels differs from what is requested. Errors are
/// BadInput with a sentence, without the file's path.
Result<ImageF> readNumpyF(const std::filesystem::path& path, int channels);
Result<Image8> readNumpy8(const std::filesystem::path& path, int channels);
/// Truth values, 0 or 1.
Result<Image8> readNumpyBool(const std::filesystem::path& path);
Result<Image16> readNumpy16(const std::filesystem::path& path, int channels);

}  // namespace dollytrack::verify
