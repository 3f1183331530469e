#pragma once

#include "render/dataset/dataset_contents.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack::render {

/// What dataset.json says of the rig: of each camera its lens with its formula, how it is carried,
/// and its pose in every frame.
[[nodiscard]] nlohmann::ordered_json rigCard(const DatasetContents& contents);

}  // namespace dollytrack::render
