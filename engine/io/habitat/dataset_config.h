#pragma once

#include "engine/core/result.h"
#include "engine/io/files/reachable_files.h"
#include "engine/io/habitat/key_check.h"
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

/// The kinds of entries in a dataset config, one per section.
enum class Kind { Stage, Object, ArticulatedObject, SceneInstance, SemanticScene };

/// The description of a model, called a template in Habitat.
struct Template {
    nlohmann::json attributes;     // the description's, with the dataset's defaults for the rest
    std::filesystem::path folder;  // file names are relative to it
    std::filesystem::path file;    // the description, or the model if it has none; empty: the
                                   // config itself describes the model
};

/// A scene of a dataset: a scene instance, or a stage without objects.
struct DatasetScene {
    std::string name;
    std::filesystem::path file;  // NAME.scene_instance.json, NAME.stage_config.json or a model
};

/// Which part of a dataset Dataset::open() reads, and its limits.
struct DatasetScope {
    bool scenes_only = false;  // only stages and scene instances
    std::uint64_t most_config_bytes = std::uint64_t{64} << 20U;
    std::size_t most_names = 10'000'000;  // file names listed and compared with patterns
};

/// A dataset of Habitat. Finds templates by the folders and the list in its config, or without a
/// config in the usual folders (stages, objects, urdf, and the same below configs). Each template
/// is read once. Not thread-safe.
class Dataset {
  public:
    /// Reads the config and lists each of its folders once. `config` may be empty. Relative paths
    /// start at `folder`. Errors: Cancelled; BadInput for a damaged config or one whose paths lead
    /// to too many folders or files.
    static Result<Dataset> open(const std::filesystem::path& config,
                                const std::filesystem::path& folder, ReachableFiles files,
                                const JobContext& job, const DatasetScope& scope = {});

    /// Finds a template by a handle of the config, a file name, a path, or a part of a file name,
    /// in this order. Null if there is none. Error: BadInput for a damaged file.
    [[nodiscard]] Result<std::shared_ptr<const Template>> find(Kind kind,
                                                               const std::string& name) const;

    /// The template name most similar to a misspelt name; empty if none is similar.
    [[nodiscard]] std::string closestTemplate(Kind kind, const std::string& name) const;

    /// Whether find() was called with more than 2,000 names that are not file names; for the names
    /// beyond that it did not try paths and parts of file names.
    [[nodiscard]] bool searchesWereCut() const;

    /// A warning if none of the config's paths of a kind leads to a file; otherwise empty.
    [[nodiscard]] std::string uselessPaths(Kind kind) const;

    /// Warnings about the parts of the dataset used so far: paths of scene instances of which none
    /// leads to a file, template names that match several files, misspelt keys. With
    /// `something_missing` also all other paths that lead to no file.
    [[nodiscard]] std::vector<std::string> warnings(bool something_missing) const;

    /// Reads the template in a file, which is a description or a model; the dataset's default
    /// attributes complete it. Error: BadInput.
    [[nodiscard]] Result<std::shared_ptr<const Template>> load(
        Kind kind, const std::filesystem::path& file) const;

    /// All existing scenes in natural order of name: scene instances, or stages if there are none.
    [[nodiscard]] std::vector<DatasetScene> scenes() const;

    /// The semantic file (a lexicon or a semantic config) with this handle in the config, otherwise
    /// with this file name, whose extension may be omitted.
    [[nodiscard]] std::optional<std::filesystem::path> findSemanticFile(
        const std::string& name) const;

    /// The path, as written in the dataset config, of the semantic file that scenes call by this
    /// handle; empty if the config has no path for it.
    [[nodiscard]] std::string semanticPathOf(const std::string& handle) const;

    /// The existing semantic files that the config lists by handle or by its paths.
    [[nodiscard]] std::vector<std::filesystem::path> semanticFiles() const;

    /// The default attributes of semantic configs.
    [[nodiscard]] const nlohmann::json& semanticDefaults() const;

    /// The lexicon named by the default attributes, searched for in the folders of semantic files.
    [[nodiscard]] std::optional<std::filesystem::path> defaultLexicon() const;

    [[nodiscard]] const ReachableFiles& files() const { return files_; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    Dataset(std::filesystem::path folder, ReachableFiles files)
        : folder_(std::move(folder)), files_(std::move(files)) {}

    /// The config's section for one kind of template.
    struct Section {
        nlohmann::json defaults = nlohmann::json::object();
        nlohmann::json::array_t configs;
        std::map<std::string, std::size_t> config_of;     // index by handle, or by file name
        std::vector<std::filesystem::path> files;         // descriptions and models
        std::map<std::string, std::size_t> file_of;       // first index by file name
        std::vector<std::filesystem::path> named_models;  // those of `files` with an extension
                                                          // that the config's paths list
        std::set<std::string> doubled;                    // file names in several folders
        std::size_t patterns = 0;
        std::vector<std::string> useless_patterns;  // paths that lead to no file
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
    ReachableFiles files_;
    std::map<Kind, Section> sections_;
    nlohmann::json lexicons_;  // semantic files by handle
    /// Templates read so far, by file and by handle of the config's list (null: file missing).
    mutable std::map<std::pair<Kind, std::filesystem::path>, std::shared_ptr<const Template>>
        by_file_;
    mutable std::map<std::pair<Kind, std::string>, std::shared_ptr<const Template>> by_handle_;
    std::string config_name_;  // file name of the config; empty without one
    mutable KeyCheck keys_;
    /// The matching files of ambiguous template names.
    mutable std::map<std::string, std::vector<std::string>> several_;
    mutable std::size_t slow_searches_ = 0;  // for names that are not file names; limited
};

}  // namespace dollytrack::habitat
