#pragma once

#include "render/dataset/dataset_contents.h"

#include <string>

namespace dollytrack::render {

/// The text of instances.csv: a header line and one row per frame and visible object.
[[nodiscard]] std::string instancesCsvText(const DatasetContents& contents);

}  // namespace dollytrack::render
