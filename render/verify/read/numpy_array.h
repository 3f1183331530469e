#pragma once

#include "engine/core/result.h"
#include "render/verify/read/image_files.h"

#include <filesystem>
#include <string>

namespace dollytrack::verify {

/// Images in NumPy's .npy files: rows x columns, or rows x columns x channels, in C's order. The
/// type and the channels are the file's own; asked for others they fail. Errors: BadInput, a
/// sentence of what the file is instead, without its place.
Result<ImageF> readNumpyF(const std::filesystem::path& path, int channels);
Result<Image8> readNumpy8(const std::filesystem::path& path, int channels);
Result<Image16> readNumpy16(const std::filesystem::path& path, int channels);

}  // namespace dollytrack::verify
