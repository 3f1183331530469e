#pragma once

#include "render/dataset/contents/format.h"

#include <string>

namespace dollytrack::render {

/// The text of instances.csv: a header line and one row per frame and visible object.
[[nodiscard]] std::string instancesCsvText(const DatasetContents& contents);

/// instances.csv of a dataset.
extern const Format kInstancesFormat;

}  // namespace dollytrack::render
