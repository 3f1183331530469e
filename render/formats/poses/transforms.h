#pragma once

#include "engine/math/pose.h"
#include "render/dataset/dataset_contents.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack::render {

/// The rows of world_from_camera for readers whose cameras have x right, y up and z back.
[[nodiscard]] nlohmann::ordered_json transformRows(const Pose& pose);

/// The frames of a transforms.json: each with its picture, its transform_matrix and, where there is
/// depth, its depth picture under `depth_key`.
[[nodiscard]] nlohmann::ordered_json transformFrames(const DatasetContents& contents,
                                                     const char* depth_key);

/// The pinhole camera as every transforms.json names it; pixel centres are at halves.
[[nodiscard]] nlohmann::ordered_json transformsLens(const DatasetContents& contents);

}  // namespace dollytrack::render
