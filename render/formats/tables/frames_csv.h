#pragma once

#include "render/dataset/dataset_contents.h"

#include <string>

namespace dollytrack::render {

/// The text of frames.csv: one row a frame of the dataset, of what can be measured about it. Speed
/// and turning are means since the frame before; empty where the camera was carried over. Targets
/// and the image score (imageScores()) are counted from the pixels. The light that was drawn for
/// each where it varies by frame.
[[nodiscard]] std::string framesCsvText(const DatasetContents& contents);

}  // namespace dollytrack::render
