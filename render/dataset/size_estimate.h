#pragma once

#include "render/dataset/dataset_contents.h"
#include "render/dataset/modalities.h"
#include "render/formats/formats.h"

#include <cstddef>
#include <cstdint>

namespace dollytrack::render {

/// Of all of a frame's files of a modality, on the high side of furnished rooms. Where flow goes to
/// several distances a frame has several files of it.
[[nodiscard]] double bytesPerPixel(const Modality& modality, std::size_t flow_distances);

/// What so many frames take, in images and in the files of these formats.
[[nodiscard]] std::uint64_t estimateBytes(const DatasetContents& contents, const FormatSet& formats,
                                          int frames);

}  // namespace dollytrack::render
