#pragma once

#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/verify/read/stored_dataset.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dollytrack::cli {

/// Arguments that identify the scene of a dataset, for commands that examine datasets.
struct DatasetSceneArguments {
    std::string path;  // scene or project; empty: search for it
    std::optional<std::string> labels;
    std::vector<std::string> models;  // folders with models
    std::optional<std::string> annotations;
    bool keep_meshes = false;
    bool with_textures = false;  // also of a dataset without albedo; no option
};

/// Adds --scene, --labels, --models, --annotations and --keep-meshes.
void addDatasetSceneArguments(CLI::App& command, DatasetSceneArguments& arguments);

/// The scene that the dataset shows, with the edits stored in dataset.json.
struct DatasetScene {
    std::shared_ptr<const Scene> scene;  // null if it was not found
    std::unique_ptr<RayCaster> rays;
    std::string missing;  // why it was not found
};

/// Opens the given scene file or project. If none is given, searches for the file named in
/// dataset.json: at its original path, in the dataset's folder, in its parent folder and in the
/// working directory, at the path in the batch that made the dataset, and at the paths in project
/// files in those folders. A file found is used only if its hash is unchanged. Errors: BadInput,
/// also if the given scene is a different one; Cancelled.
Result<DatasetScene> openDatasetScene(const verify::StoredDataset& dataset,
                                      const DatasetSceneArguments& arguments,
                                      const JobContext& job);

}  // namespace dollytrack::cli
