#pragma once

#include "engine/core/result.h"
#include "engine/io/sandbox/reachable_files.h"

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

/// The dataset configs (NAME.scene_dataset_config.json) of the dataset that a scene file belongs
/// to, by name: those of the nearest folder that has any, which is the scene's own or one of the
/// four above. No file is opened. Symbolic links are skipped; of more than 16 configs the first
/// count.
[[nodiscard]] std::vector<std::filesystem::path> findDatasetConfigs(
    const std::filesystem::path& scene);

/// Of several configs the first that lists a scene in the scene's own folder, else the first of
/// all; empty without configs. It reads the configs, so only the process that reads scenes calls
/// it.
[[nodiscard]] std::filesystem::path chooseDatasetConfig(
    const std::vector<std::filesystem::path>& configs, const std::filesystem::path& scene);

/// A dataset of Habitat: finds templates by the folders and the list of its config. Without a
/// config they are looked up in the usual folders (stages, objects, urdf and the same in configs).
class Dataset {
  public:
    /// `config` may be empty; names then count from `folder`. Lists every folder of the config
    /// once. Error: BadInput, for a damaged config and for one that names too many folders or
    /// files.
    static Result<Dataset> open(const std::filesystem::path& config,
                                const std::filesystem::path& folder, io::ReachableFiles files);

    /// The template of this name: a handle of the config, the name of a file, a path to one, or a
    /// part of a file's name. Nothing where no file fits. Error: BadInput, for a file that is
    /// damaged.
    [[nodiscard]] Result<std::optional<Template>> find(Kind kind, const std::string& name) const;

    /// The template in this file, a description or a model, with the dataset's default attributes.
    /// Error: BadInput.
    [[nodiscard]] Result<Template> load(Kind kind, const std::filesystem::path& file) const;

    /// Every scene that is there, in order of name.
    [[nodiscard]] std::vector<DatasetScene> scenes() const;

    /// The file that the config gives a semantic lexicon's handle, else of that name.
    [[nodiscard]] std::optional<std::filesystem::path> findLexicon(const std::string& name) const;

    [[nodiscard]] const io::ReachableFiles& files() const { return files_; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    Dataset(std::filesystem::path folder, io::ReachableFiles files)
        : folder_(std::move(folder)), files_(std::move(files)) {}

    /// What the config says of one kind of template.
    struct Section {
        nlohmann::json defaults = nlohmann::json::object();
        nlohmann::json::array_t configs;
        std::map<std::string, std::size_t> config_of;     // by handle, else by the file's name
        std::vector<std::filesystem::path> files;         // descriptions and models
        std::map<std::string, std::size_t> file_of;       // by file name; the first of several
        std::vector<std::filesystem::path> named_models;  // of `files`: the paths ask for models
    };
    class FolderSearch;
    Status readSection(const nlohmann::json& values, Kind kind, FolderSearch& search);
    [[nodiscard]] Result<std::optional<Template>> findConfigured(const Section& section, Kind kind,
                                                                 const std::string& handle) const;
    [[nodiscard]] std::optional<std::filesystem::path> findFile(Kind kind,
                                                                const std::string& name) const;

    std::filesystem::path folder_;
    io::ReachableFiles files_;
    std::map<Kind, Section> sections_;
    nlohmann::json lexicons_;
    mutable std::size_t slow_searches_ = 0;  // for names that are no file's own; limited
};

}  // namespace dollytrack::habitat
