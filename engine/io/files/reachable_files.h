#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// Finds the files below several folders. A file in one folder may name files in another, relative
/// to its own folder ("../meshes/chair.glb"). Paths that lead out of all the folders, by ".." or by
/// symbolic links, are treated as missing.
class ReachableFiles {
  public:
    /// `folders` are absolute, without "." and ".."; see foldersFor() in model_library.h.
    explicit ReachableFiles(std::vector<std::filesystem::path> folders)
        : folders_(std::move(folders)) {}

    [[nodiscard]] const std::vector<std::filesystem::path>& folders() const { return folders_; }

    /// The absolute path of the file that `name` refers to, relative to `folder`. Empty if it is
    /// missing.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path& folder,
                                                            const std::string& name) const;

    /// Whether this file or folder exists below one of the folders. Symbolic links below them are
    /// not followed, and are not files themselves.
    [[nodiscard]] bool reaches(const std::filesystem::path& path) const;

    /// The names of the files and folders in `folder`, sorted, if it exists below one of the
    /// folders. Symbolic links and names that begin with a dot are left out. Error: BadInput if the
    /// folder holds more than 100,000.
    [[nodiscard]] Result<std::vector<std::string>> namesIn(
        const std::filesystem::path& folder) const;

  private:
    /// A path as one of the given folders and the part below it.
    struct Place {
        std::filesystem::path root;
        std::filesystem::path below;  // from the root; "." is the root itself
    };

    /// Where a path lies below the folders, by its name alone: one place for each folder around it.
    [[nodiscard]] std::vector<Place> placesOf(const std::filesystem::path& path) const;
    /// Whether a file or folder is there, reached through no symbolic link below the root.
    [[nodiscard]] static bool exists(const Place& place);

    std::vector<std::filesystem::path> folders_;
};

/// The path made absolute, without ".", ".." and a trailing slash.
[[nodiscard]] std::filesystem::path absoluteNormal(const std::filesystem::path& path);

}  // namespace dollytrack
