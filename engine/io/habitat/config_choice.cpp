#include "engine/io/habitat/config_choice.h"

#include "engine/io/files/reachable_files.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kConfigEnding = ".scene_dataset_config.json";
constexpr std::size_t kMostConfigs = 16;  // per folder

std::vector<fs::path> configsIn(const fs::path& folder) {
    std::vector<fs::path> configs;
    std::error_code error;
    fs::directory_iterator at(folder, error);
    for (const fs::directory_iterator end; !error && at != end; at.increment(error)) {
        std::error_code unknown;
        if (isDatasetConfig(at->path()) && !at->is_symlink(unknown)) {
            configs.push_back(at->path());
        }
    }
    std::sort(configs.begin(), configs.end());
    if (configs.size() > kMostConfigs) configs.resize(kMostConfigs);
    return configs;
}

}  // namespace

bool isDatasetConfig(const fs::path& path) {
    return path.filename().string().ends_with(kConfigEnding);
}

std::vector<fs::path> findDatasetConfigs(const fs::path& scene) {
    constexpr int kMostFoldersUp = 4;
    fs::path folder = absoluteNormal(scene).parent_path();
    for (int up = 0; up <= kMostFoldersUp && folder.has_relative_path(); ++up) {
        std::vector<fs::path> configs = configsIn(folder);
        if (!configs.empty()) return configs;
        folder = folder.parent_path();
    }
    return {};
}

ConfigChoice::ConfigChoice(DatasetScope scope, JobContext job)
    : scope_(scope), job_(std::move(job)) {
    scope_.scenes_only = true;
}

const ConfigChoice::Listed& ConfigChoice::listedBy(const fs::path& config) {
    const auto [at, is_new] = listed_.try_emplace(config);
    if (!is_new) return at->second;
    const fs::path folder = config.parent_path();
    const auto dataset = Dataset::open(config, folder, ReachableFiles({folder}), job_, scope_);
    if (!dataset) return at->second;
    for (const DatasetScene& scene : dataset->scenes()) {
        at->second.scenes.insert(scene.file);
        at->second.folders.insert(scene.file.parent_path());
    }
    return at->second;
}

fs::path ConfigChoice::choose(const std::vector<fs::path>& configs, const fs::path& scene) {
    if (configs.empty()) return {};
    if (configs.size() == 1) return configs.front();
    const fs::path own = absoluteNormal(scene).parent_path();
    for (const fs::path& config : configs) {
        if (listedBy(config).folders.contains(own)) return config;
    }
    return configs.front();
}

bool ConfigChoice::lists(const fs::path& config, const fs::path& scene) {
    return listedBy(config).scenes.contains(absoluteNormal(scene));
}

}  // namespace dollytrack::habitat
