#pragma once

#include "engine/io/settings/cloud_params.h"
#include "engine/math/up_axis.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace dollytrack {

/// Options for reading a scene file.
struct ImportOptions {
    std::optional<double> unit_m = std::nullopt;   // metres per source unit; empty: estimated
    std::optional<UpAxis> up_axis = std::nullopt;  // empty: estimated
    std::optional<std::filesystem::path> labels =
        std::nullopt;  // label file: words added to the built-in ones, or classes for datasets
    /// Folders with the models of composed scenes, such as 3D-FUTURE-model or ShapeNetCore; for
    /// homes also archives.
    std::vector<std::filesystem::path> model_folders = {};
    /// An annotation file, or Hypersim's folder ai_VVV_NNN or its _detail.
    std::optional<std::filesystem::path> annotations = std::nullopt;
    CloudParams cloud = {};        // for point clouds
    bool regroup = true;           // regroup meshes of several objects, join split objects
    bool read_textures = true;     // false: textures are named, but empty
    double small_volume_m3 = 0.1;  // objects with a smaller volume are small
    double size_ratio = 5.0;       // so are those this many times smaller than their support
    bool in_process = false;       // read without the sandbox; a damaged file may crash the program
    bool use_cache = false;        // use SceneCache
};

}  // namespace dollytrack
