#pragma once

#include "engine/io/habitat/dataset_config.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <map>
#include <set>
#include <vector>

namespace dollytrack::habitat {

/// Whether a file is a dataset config by its name: NAME.scene_dataset_config.json.
[[nodiscard]] bool isDatasetConfig(const std::filesystem::path& path);

/// The dataset configs of the dataset that a scene file belongs to, in order of name: those in the
/// nearest folder that contains any, out of the scene's folder and the four above it. No file is
/// opened. Symbolic links are skipped; only the first 16 configs of a folder are returned.
[[nodiscard]] std::vector<std::filesystem::path> findDatasetConfigs(
    const std::filesystem::path& scene);

/// Chooses the dataset config of a scene. Each config is read once; an unreadable one counts as
/// empty.
class ConfigChoice {
  public:
    ConfigChoice(DatasetScope scope, JobContext job);

    /// The config to use: the first that lists a scene in the scene's folder, otherwise the first;
    /// empty without configs.
    [[nodiscard]] std::filesystem::path choose(const std::vector<std::filesystem::path>& configs,
                                               const std::filesystem::path& scene);

    /// Whether the config lists this scene file.
    [[nodiscard]] bool lists(const std::filesystem::path& config,
                             const std::filesystem::path& scene);

  private:
    struct Listed {
        std::set<std::filesystem::path> scenes;
        std::set<std::filesystem::path> folders;  // of the scenes
    };
    const Listed& listedBy(const std::filesystem::path& config);

    DatasetScope scope_;
    JobContext job_;
    std::map<std::filesystem::path, Listed> listed_;  // by config
};

}  // namespace dollytrack::habitat
