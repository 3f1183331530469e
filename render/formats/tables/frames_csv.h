#pragma once

#include "render/dataset/contents/format.h"

#include <string>

namespace dollytrack::render {

/// The text of frames.csv: measurements, one row per frame. Speed and turn rate are means since the
/// previous frame; empty at the start of a path. Targets and the image score (imageScores()) come
/// from the pixels. If light varies by frame, each frame's light parameters are added.
[[nodiscard]] std::string framesCsvText(const DatasetContents& contents);

/// frames.csv of a dataset.
extern const Format kFramesFormat;

}  // namespace dollytrack::render
