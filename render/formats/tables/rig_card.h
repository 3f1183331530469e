#pragma once

#include "render/dataset/contents/dataset_contents.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack::render {

/// Description of the rig for dataset.json: each camera's lens with its projection formula, how it
/// is mounted, and its pose in every frame.
[[nodiscard]] nlohmann::ordered_json rigCard(const DatasetContents& contents);

}  // namespace dollytrack::render
