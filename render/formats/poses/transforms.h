#pragma once

#include "engine/math/pose.h"
#include "render/dataset/contents/dataset_contents.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack::render {

/// Rows of world_from_camera for camera axes x right, y up, z back.
[[nodiscard]] nlohmann::ordered_json transformRows(const Pose& pose);

/// The frames of a transforms.json: each with its image, its transform_matrix and, if there is
/// depth, its depth image under `depth_key`.
[[nodiscard]] nlohmann::ordered_json transformFrames(const DatasetContents& contents,
                                                     const char* depth_key);

/// Pinhole parameters in the keys of transforms.json; pixel centres are at half integers.
[[nodiscard]] nlohmann::ordered_json transformsLens(const DatasetContents& contents);

}  // namespace dollytrack::render
