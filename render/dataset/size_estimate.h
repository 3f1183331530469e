#pragma once

#include "render/dataset/contents/dataset_contents.h"
#include "render/dataset/contents/format.h"
#include "render/dataset/contents/modality.h"

#include <cstddef>
#include <cstdint>

namespace dollytrack::render {

/// Bytes of all files of a modality for a frame of so many pixels, on the high side for furnished
/// rooms. With several flow distances a frame has several flow files.
[[nodiscard]] double bytesPerFrame(const Modality& modality, double pixels,
                                   std::size_t flow_distances);

/// Estimated size of this many frames: images and format files.
[[nodiscard]] std::uint64_t estimateBytes(const DatasetContents& contents, const FormatSet& formats,
                                          int frames);

}  // namespace dollytrack::render
