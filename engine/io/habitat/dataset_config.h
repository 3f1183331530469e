#pragma once

#include "engine/core/result.h"
#include "engine/io/habitat/key_check.h"
#include "engine/io/sandbox/reachable_files.h"
#include "engine/jobs/job.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::habitat {

class FolderSearch;

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

/// What Dataset::open() reads of a dataset, and how much at most.
struct DatasetScope {
    bool scenes_only = false;  // stages and scene instances alone
    std::uint64_t most_config_bytes = std::uint64_t{64} << 20U;
    std::size_t most_names = 10'000'000;  // listed and compared with patterns
};

/// A dataset of Habitat: finds templates by the folders and the list of its config. Without a
/// config they are looked up in the usual folders (stages, objects, urdf and the same in configs).
/// Each template is read once. For one thread.
class Dataset {
  public:
    /// `config` may be empty; names then count from `folder`. Lists every folder of the config
    /// once. Errors: Cancelled; BadInput, for a damaged config and for one that names too many
    /// folders or files.
    static Result<Dataset> open(const std::filesystem::path& config,
                                const std::filesystem::path& folder, io::ReachableFiles files,
                                const JobContext& job, const DatasetScope& scope = {});

    /// The template of this name: a handle of the config, the name of a file, a path to one, or a
    /// part of a file's name. Null where no file fits. Error: BadInput, for a file that is
    /// damaged.
    [[nodiscard]] Result<std::shared_ptr<const Template>> find(Kind kind,
                                                               const std::string& name) const;

    /// The name of a template that this wrong name is close to; empty without one.
    [[nodiscard]] std::string closestTemplate(Kind kind, const std::string& name) const;

    /// Whether more than 2,000 names were no file's own, so that find() did not look for the rest
    /// by paths and parts of names.
    [[nodiscard]] bool searchesWereCut() const;

    /// A sentence on the paths of a kind, none of which leads to a file; empty where one does.
    [[nodiscard]] std::string uselessPaths(Kind kind) const;

    /// What is doubtful about the dataset, as far as it was used: paths that lead nowhere, names of
    /// templates that fit several files, misspelt keys. With `something_missing` also single paths
    /// that lead nowhere.
    [[nodiscard]] std::vector<std::string> warnings(bool something_missing) const;

    /// The template in this file, a description or a model, with the dataset's default attributes.
    /// Error: BadInput.
    [[nodiscard]] Result<std::shared_ptr<const Template>> load(
        Kind kind, const std::filesystem::path& file) const;

    /// Every scene that is there, in natural order of name.
    [[nodiscard]] std::vector<DatasetScene> scenes() const;

    /// The semantic file (a lexicon, a semantic config) that the config gives this handle, else of
    /// that name, also without its ending.
    [[nodiscard]] std::optional<std::filesystem::path> findSemanticFile(
        const std::string& name) const;

    /// The path that the config writes for a semantic file's handle; empty without one.
    [[nodiscard]] std::string semanticPathOf(const std::string& handle) const;

    /// The semantic files that the config lists by handle or that its paths lead to.
    [[nodiscard]] std::vector<std::filesystem::path> semanticFiles() const;

    /// The default attributes of semantic configs.
    [[nodiscard]] const nlohmann::json& semanticDefaults() const;

    /// The lexicon that the default attributes name, looked up where semantic configs lie.
    [[nodiscard]] std::optional<std::filesystem::path> defaultLexicon() const;

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
        std::set<std::string> doubled;  // names of files that lie in several folders
        std::size_t patterns = 0;
        std::vector<std::string> useless_patterns;  // that lead to no file
    };
    Status readSection(const nlohmann::json& values, Kind kind, FolderSearch& search);
    [[nodiscard]] Result<std::shared_ptr<const Template>> findConfigured(
        const Section& section, Kind kind, const std::string& handle) const;
    void checkKeys(const nlohmann::json& attributes, Kind kind, const std::string& file) const;
    void noteSeveral(const std::string& name, const Section& section,
                     const std::string& file_name) const;
    [[nodiscard]] std::optional<std::filesystem::path> findFile(Kind kind,
                                                                const std::string& name) const;

    std::filesystem::path folder_;
    io::ReachableFiles files_;
    std::map<Kind, Section> sections_;
    nlohmann::json lexicons_;  // files by handle
    /// Read so far: by file, and by handle of the config's own list (null: its file is missing).
    mutable std::map<std::pair<Kind, std::filesystem::path>, std::shared_ptr<const Template>>
        by_file_;
    mutable std::map<std::pair<Kind, std::string>, std::shared_ptr<const Template>> by_handle_;
    std::string config_name_;  // of the config's file; empty without one
    mutable KeyCheck keys_;
    /// The files that the names of templates fit, where those are several.
    mutable std::map<std::string, std::vector<std::string>> several_;
    mutable std::size_t slow_searches_ = 0;  // for names that are no file's own; limited
};

}  // namespace dollytrack::habitat
