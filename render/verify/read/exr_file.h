#pragma once

#include "render/verify/read/image_files.h"

#include <string_view>

namespace dollytrack::verify {

/// Decodes the channel "Y" of an OpenEXR image as floats, row 0 at the top, or with 3 `channels`
/// "R", "G" and "B". Returns BadInput if the bytes are damaged, a channel is missing, or the image
/// has more than 2^26 pixels.
[[nodiscard]] Result<ImageF> decodeExr(std::string_view bytes, int channels = 1);

}  // namespace dollytrack::verify
