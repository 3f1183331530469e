#pragma once

#include "render/verify/read/image_files.h"

#include <string_view>

namespace dollytrack::verify {

/// Decodes the channel "Y" of an OpenEXR image as floats, row 0 at the top. Returns BadInput if the
/// bytes are damaged, there is no such channel, or the image has more than 2^26 pixels.
[[nodiscard]] Result<ImageF> decodeExr(std::string_view bytes);

}  // namespace dollytrack::verify
