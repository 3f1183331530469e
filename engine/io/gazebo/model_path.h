#pragma once

#include "engine/io/files/reachable_files.h"
#include "engine/io/settings/import_options.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::gazebo {

/// Finds the files of model://, package://, file:// and plain names in the folders that may be
/// read. Not thread-safe.
class ModelPath {
  public:
    explicit ModelPath(ReachableFiles files) : files_(std::move(files)) {}

    /// The file that `uri`, written in a file of `folder`, refers to; nullopt if it is not found.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path& folder,
                                                            const std::string& uri) const;
    /// The files in the folder that `uri` refers to, or the file itself; empty if it is missing.
    [[nodiscard]] std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder,
                                                             const std::string& uri) const;
    /// Whether this file or folder may be read.
    [[nodiscard]] bool reaches(const std::filesystem::path& path) const {
        return files_.reaches(path);
    }
    /// The description of the model that an <include> names: a file, or that of a folder with a
    /// model.config or model.sdf. Models of Gazebo Fuel are searched for among downloaded ones.
    [[nodiscard]] std::optional<std::filesystem::path> findModel(
        const std::filesystem::path& folder, const std::string& uri) const;

    /// Why find() did not find a mesh.
    enum class Absence {
        NoFolder,   // the folder that its address names is not there either
        NoFile,     // only the file is not there
        OtherCase,  // a file is there whose name differs in upper and lower case
    };
    [[nodiscard]] Absence absenceOf(const std::filesystem::path& folder,
                                    const std::string& uri) const;

  private:
    /// The folders in which a model or package is searched for: the given ones and those around
    /// `folder`.
    [[nodiscard]] std::vector<std::filesystem::path> rootsFor(
        const std::filesystem::path& folder) const;
    /// Finds a file of another machine by the last names of its path, as many as possible, in the
    /// given folders, in `folder` and in the one around it.
    [[nodiscard]] std::optional<std::filesystem::path> findByTail(
        const std::filesystem::path& folder, const std::filesystem::path& absolute) const;
    const std::string& nameOf(const std::filesystem::path& config) const;

    ReachableFiles files_;
    mutable std::map<std::filesystem::path, std::string> names_;  // cache of nameOf()
};

/// The folders in which a world or robot may refer to files: those of the options, its own,
/// `models`, `meshes` and the like beside it, its package and, for a model, the folder that
/// contains the model's folder.
[[nodiscard]] std::vector<std::filesystem::path> foldersOfWorld(const std::filesystem::path& scene,
                                                                const ImportOptions& options);

}  // namespace dollytrack::gazebo
