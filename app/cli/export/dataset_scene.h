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

/// Which scene a dataset was made of, for commands that look at a dataset again.
struct DatasetSceneArguments {
    std::string path;  // scene or project; empty: looked for
    std::optional<std::string> labels;
    std::vector<std::string> models;  // folders
    std::optional<std::string> annotations;
    bool keep_meshes = false;
    bool with_textures = false;  // also of a dataset without albedo; no option
};

/// --scene, --labels, --models, --annotations, --keep-meshes
void addDatasetSceneArguments(CLI::App& command, DatasetSceneArguments& arguments);

/// The scene that the dataset shows, as it was then: with the edits that dataset.json has.
struct DatasetScene {
    std::shared_ptr<const Scene> scene;  // null when it is not at hand
    std::unique_ptr<RayCaster> rays;
    std::string missing;  // why there is none
};

/// The scene file or project given; else the file that dataset.json names, in the dataset's folder,
/// beside it, in the working folder, where the batch had it from that made it, or where a project
/// in one of the first three has it, if it still is the same. Errors: BadInput, also when the scene
/// given is another one; Cancelled.
Result<DatasetScene> openDatasetScene(const verify::StoredDataset& dataset,
                                      const DatasetSceneArguments& arguments,
                                      const JobContext& job);

}  // namespace dollytrack::cli
