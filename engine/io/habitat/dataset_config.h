#pragma once

#include "engine/core/result.h"
#include "engine/io/import/reachable_files.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::habitat {

/// What a dataset config lists under one of its keys.
enum class Kind { Stage, Object, ArticulatedObject, SceneInstance, SemanticScene };

/// A description of a model, and where it comes from.
struct Template {
    nlohmann::json attributes;     // the dataset's default attributes beneath the file's own
    std::filesystem::path folder;  // names of files count from it
    std::filesystem::path file;    // of the description, or the model itself
};

/// A scene of a dataset: a scene instance, or a stage without objects.
struct DatasetScene {
    std::string name;
    std::filesystem::path file;  // NAME.scene_instance.json, NAME.stage_config.json or a model
};

/// The dataset config that a scene instance belongs to: the first NAME.scene_dataset_config.json,
/// by name, in its folder or one of the four above; nothing where there is none. Of several in one
/// folder the one whose scenes lie in the instance's folder counts.
[[nodiscard]] std::optional<std::filesystem::path> findDatasetConfig(
    const std::filesystem::path& scene_instance);

/// A dataset of Habitat: finds templates by the folders and the list of its config. Without a
/// config they are looked up in the usual folders (stages, objects, urdf and the same in configs).
class Dataset {
  public:
    /// `config` may be empty; names then count from `folder`.
    static Result<Dataset> open(const std::filesystem::path& config,
                                const std::filesystem::path& folder, io::ReachableFiles files);

    /// The template of this name: a handle of the config, the name of a file, a path to one, or a
    /// part of a file's name. Nothing where there is none. Error: BadInput, for a file that is damaged.
    [[nodiscard]] Result<std::optional<Template>> find(Kind kind, const std::string& name) const;

    /// Every scene, in order of name.
    [[nodiscard]] std::vector<DatasetScene> scenes() const;

    /// The file that the config gives a semantic lexicon's handle, else of that name.
    [[nodiscard]] std::optional<std::filesystem::path> findLexicon(const std::string& name) const;

    [[nodiscard]] const io::ReachableFiles& files() const { return files_; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    Dataset(std::filesystem::path folder, io::ReachableFiles files)
        : folder_(std::move(folder)), files_(std::move(files)) {}

    struct Places {
        nlohmann::json defaults = nlohmann::json::object();
        nlohmann::json::array_t configs;
        std::vector<std::filesystem::path> folders;
        std::vector<std::filesystem::path> files;
    };
    void readPlaces(const nlohmann::json& section, Kind kind);
    [[nodiscard]] std::optional<std::filesystem::path> findPart(const Places& places,
                                                                std::string_view ending,
                                                                const std::string& part) const;
    [[nodiscard]] Result<Template> load(const std::filesystem::path& file,
                                        const Places& places) const;

    std::filesystem::path folder_;
    io::ReachableFiles files_;
    std::map<Kind, Places> places_;
    nlohmann::json lexicons_;
};

}  // namespace dollytrack::habitat
