#pragma once

#include "engine/core/result.h"
#include "render/verify/read/image.h"

#include <cstdint>
#include <filesystem>

namespace dollytrack::verify {

using Image8 = Image<std::uint8_t>;
using Image16 = Image<std::uint16_t>;
using ImageF = Image<float>;

/// Readers of a dataset's images: none of the code that wrote them. The type and the number of
/// channels are the file's own; asked for others they fail. Errors: BadInput, a sentence of what
/// the file is instead, without its place.
Result<Image8> readImage8(const std::filesystem::path& path, int channels);
Result<Image16> readImage16(const std::filesystem::path& path, int channels);
/// Ids of classes, one channel of 8 or 16 bits.
Result<Image16> readClasses(const std::filesystem::path& path, bool wide);
/// The same values in 16 bits.
Result<Image16> widened(const Result<Image8>& image);
/// OpenEXR, 32-bit.
Result<ImageF> readImageF(const std::filesystem::path& path, int channels);
/// Middlebury .flo: two channels, right and down.
Result<ImageF> readFlow(const std::filesystem::path& path);

}  // namespace dollytrack::verify
