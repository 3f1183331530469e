#include "engine/io/habitat/habitat_reader.h"

#include "engine/core/clean_text.h"
#include "engine/core/log.h"
#include "engine/core/text_lists.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_record.h"
#include "engine/io/habitat/attributes.h"
#include "engine/io/habitat/config_choice.h"
#include "engine/io/habitat/dataset_config.h"
#include "engine/io/habitat/scene_builder.h"
#include "engine/io/semantics/label_files.h"
#include "engine/io/settings/import_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace dollytrack::habitat {
namespace {

namespace fs = std::filesystem;

/// The configs of the dataset that a scene belongs to; for a config, the config itself.
std::vector<fs::path> configsOf(const fs::path& path) {
    if (isDatasetConfig(path)) return {absoluteNormal(path)};
    return findDatasetConfigs(path);
}

/// The folder of the dataset: that of its configs, otherwise the folder above "scenes", "objects"
/// and the like around the scene. Never the file system's root, unless the scene is in it.
fs::path datasetFolder(const fs::path& path, const std::vector<fs::path>& configs) {
    if (!configs.empty()) return configs.front().parent_path();
    fs::path folder = absoluteNormal(path).parent_path();
    for (const char* name : {"scenes", "scene_instances", "stages", "objects", "configs"}) {
        const bool above = folder.parent_path().has_relative_path();
        if (folder.filename() == name && above) folder = folder.parent_path();
    }
    return folder;
}

/// The folders that a scene may read: its dataset's, its own, and those given by the user.
std::vector<fs::path> foldersOf(const fs::path& path, const std::vector<fs::path>& configs,
                                const ImportOptions& options) {
    std::vector<fs::path> folders = {datasetFolder(path, configs),
                                     absoluteNormal(path).parent_path()};
    for (const fs::path& folder : options.model_folders) {
        folders.push_back(absoluteNormal(folder));
    }
    return folders;
}

Result<Dataset> datasetOf(const fs::path& path, const ImportOptions& options,
                          const JobContext& job) {
    const std::vector<fs::path> configs = configsOf(path);
    const std::vector<fs::path> folders = foldersOf(path, configs, options);
    if (!isDatasetConfig(path)) {
        // A config added to one of these folders would change the scene, so their listings are
        // recorded as inputs.
        fs::path folder = absoluteNormal(path).parent_path();
        InputRecord::note(InputUse::Listing, folder);
        while (folder != folders.front() && folder.has_relative_path()) {
            folder = folder.parent_path();
            InputRecord::note(InputUse::Listing, folder);
        }
    }
    return Dataset::open(ConfigChoice({}, job).choose(configs, path), folders.front(),
                         ReachableFiles(folders), job);
}

/// Dataset::uselessPaths() of scene instances, as a continuation of an error message.
std::string uselessScenePaths(const Dataset& dataset) {
    const std::string line = dataset.uselessPaths(Kind::SceneInstance);
    return line.empty() ? line : "; " + line;
}

tl::unexpected<Error> severalScenes(const std::vector<DatasetScene>& scenes, const fs::path& path,
                                    const Dataset& dataset) {
    if (scenes.empty()) {
        return fail(ErrorCode::BadInput,
                    "no scene instance and no stage that the dataset config lists exists; check "
                    "its paths" +
                        uselessScenePaths(dataset),
                    path.string());
    }
    std::vector<std::string> names;
    for (const DatasetScene& scene : scenes) names.push_back(cleanText(scene.name));
    return fail(ErrorCode::BadInput,
                fmt::format("the dataset has {} scenes ({}); name the file of one, such as {}, or "
                            "plan all of them with 'dollytrack batch'{}",
                            scenes.size(), listOf(names, 5), scenes.front().file.string(),
                            uselessScenePaths(dataset)),
                path.string());
}

/// The error for a batch if a scene would be read with another config than the named one.
tl::unexpected<Error> readWithAnother(const fs::path& other, const DatasetScene& scene,
                                      const fs::path& config) {
    const std::string name = cleanText(scene.name);
    if (other.empty()) {
        return fail(ErrorCode::BadInput,
                    "the scene " + name +
                        " does not use this config, which is a link or too far above the scene; "
                        "put the file itself at most four folders above",
                    config.string());
    }
    return fail(ErrorCode::BadInput,
                "the scene " + name + " is read with " + cleanText(other.string()) +
                    ", not with this config; name the other config, or move it elsewhere",
                config.string());
}

bool holdsAny(std::string_view head, std::initializer_list<std::string_view> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
        return head.find(key) != std::string_view::npos;
    });
}

}  // namespace

bool likeHabitat(std::string_view head) {
    if (firstLetter(head) != '{') return false;
    if (holdsAny(head, {"\"stage_instance\"", "\"object_instances\"", "\"render_asset\"",
                        "\"articulated_object_instances\""})) {
        return true;
    }
    return holdsAny(head, {"\"stages\"", "\"scene_instances\"", "\"objects\""}) &&
           holdsAny(head, {"\"paths\"", "\"default_attributes\"", "\"configs\""});
}

bool isHabitatPart(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.ends_with(".stage_config.json") || name.ends_with(".object_config.json");
}

Result<RawScene> readHabitat(const fs::path& path, const ImportOptions& options,
                             const JobContext& job) {
    const Result<LabelTable> labels = labelsOf(options);
    if (!labels) return tl::unexpected(labels.error());
    const Result<Dataset> dataset = datasetOf(path, options, job);
    if (!dataset) return tl::unexpected(dataset.error());
    fs::path scene = absoluteNormal(path);
    if (isDatasetConfig(path)) {
        const std::vector<DatasetScene> scenes = dataset->scenes();
        if (scenes.size() != 1) return severalScenes(scenes, path, *dataset);
        scene = scenes.front().file;
    }
    const std::string name = scene.filename().string();
    Kind kind = Kind::SceneInstance;
    if (name.ends_with(".stage_config.json") || scene.extension() != ".json") kind = Kind::Stage;
    if (name.ends_with(".object_config.json")) kind = Kind::Object;
    const auto loaded = dataset->load(kind, scene);
    if (!loaded) return tl::unexpected(loaded.error());
    const Template& document = **loaded;
    return document.attributes.contains("render_asset")
               ? readPart(scene, document, *dataset, *labels, job)
               : readSceneInstance(scene, document.attributes, *dataset, *labels, job);
}

std::vector<fs::path> habitatInputs(const fs::path& path, const ImportOptions& options) {
    return foldersOf(path, configsOf(path), options);
}

Result<std::vector<fs::path>> scenesOfDataset(const fs::path& given,
                                              const std::vector<fs::path>& also_named) {
    constexpr DatasetScope kScope = {true, std::uint64_t{1} << 20U, 100'000};
    const fs::path config = absoluteNormal(given);
    const fs::path folder = config.parent_path();
    const JobContext job;
    const auto dataset = Dataset::open(config, folder, ReachableFiles({folder}), job, kScope);
    if (!dataset) return tl::unexpected(dataset.error());
    ConfigChoice choice(kScope, job);
    std::map<fs::path, fs::path> chosen;  // config by the scenes' folder
    std::vector<fs::path> files;
    for (const DatasetScene& scene : dataset->scenes()) {
        if (scene.file.extension() != ".json") {
            const auto stage = dataset->load(Kind::Stage, scene.file);
            if (!stage) return tl::unexpected(stage.error());
            // A job of a batch is given only the model, without the config. The axes of labelled
            // models are found without it.
            if (changesGeometry(**stage) && !semantics::findLabelledFiles(scene.file)) {
                return fail(ErrorCode::BadInput,
                            "the config gives axes or a size to stages without a stage config; "
                            "write NAME.stage_config.json beside each, or list the models with "
                            "their upward axis and unit",
                            config.string());
            }
        } else {
            const auto [at, is_new] = chosen.try_emplace(scene.file.parent_path());
            if (is_new) at->second = choice.choose(findDatasetConfigs(scene.file), scene.file);
            const bool named = std::ranges::find(also_named, at->second) != also_named.end();
            if (at->second != config && !(named && choice.lists(at->second, scene.file))) {
                return readWithAnother(at->second, scene, config);
            }
        }
        files.push_back(scene.file);
    }
    if (files.empty()) return severalScenes({}, config, *dataset);
    const std::string useless = dataset->uselessPaths(Kind::SceneInstance);
    if (!useless.empty()) {
        log::warn("import",
                  fmt::format("{}; there are no scene instances, so each of {} stages is a scene",
                              useless, files.size()));
    }
    return files;
}

}  // namespace dollytrack::habitat
