#pragma once

#include "engine/core/result.h"
#include "engine/io/pointcloud/cloud_params.h"
#include "engine/jobs/job.h"
#include "engine/math/up_axis.h"
#include "engine/scene/scene.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace dollytrack {

/// What a user can say about a scene file that the file does not say itself.
struct ImportOptions {
    std::optional<double> unit_m = std::nullopt;   // metres per source unit; else found out
    std::optional<UpAxis> up_axis = std::nullopt;  // else found out
    std::optional<std::filesystem::path> labels =
        std::nullopt;  // a label file: words added to the built-in ones, or classes of one's own
    /// Where the models of scenes made of models are: 3D-FUTURE-model, ShapeNetCore and the
    /// like; homes take archives, too.
    std::vector<std::filesystem::path> model_folders = {};
    /// A folder that says which mesh is what: Hypersim's ai_VVV_NNN or its _detail.
    std::optional<std::filesystem::path> annotations = std::nullopt;
    CloudParams cloud = {};        // how a point cloud becomes a room
    bool regroup = true;           // take apart meshes of several objects, join split objects
    bool read_textures = true;     // else they are named, but empty
    double small_volume_m3 = 0.1;  // smaller objects are small
    double size_ratio = 5.0;       // also small: this many times smaller than what carries it
    bool in_process = false;       // read here; a damaged file may then end this program
    bool use_cache = false;        // keep what was read, and take what is kept (io::SceneCache)
};

/// Reads a scene file of one of the kinds of scene_format.h into a scene: objects, classes, boxes,
/// fronts, unit and up axis found, everything repaired or doubtful said in Scene::report.
/// The only door to third-party model readers.
Result<Scene> importScene(const std::filesystem::path& path, const ImportOptions& options = {},
                          const JobContext& job = {});

}  // namespace dollytrack
