#pragma once

#include "engine/core/result.h"
#include "render/verify/read/image.h"

#include <cstdint>
#include <filesystem>

namespace dollytrack::verify {

using Image8 = Image<std::uint8_t>;
using Image16 = Image<std::uint16_t>;
using ImageF = Image<float>;

/// Image readers, independent of the writers' code. They fail if the file's type or number of
/// channels differs from what is requested. Errors are BadInput with a sentence, without the file's
/// path.
Result<Image8> readImage8(const std::filesystem::path& path, int channels);
Result<Image16> readImage16(const std::filesystem::path& path, int channels);
/// Class ids, one channel of 8 or 16 bits.
Result<Image16> readClasses(const std::filesystem::path& path, bool wide);
/// Converts 8 to 16 bits; passes an error on.
Result<Image16> widened(const Result<Image8>& image);
/// OpenEXR, one channel of 32-bit floats.
Result<ImageF> readImageF(const std::filesystem::path& path, int channels);
/// Middlebury .flo: two channels, px right and down.
Result<ImageF> readFlow(const std::filesystem::path& path);

}  // namespace dollytrack::verify
