#pragma once

#include "render/dataset/dataset_contents.h"

#include <string>

namespace dollytrack::render {

/// instances.csv: a row a frame and thing that it shows, with a line of names above.
[[nodiscard]] std::string instancesCsvText(const DatasetContents& contents);

}  // namespace dollytrack::render
