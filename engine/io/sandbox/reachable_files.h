#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// The files below several folders, found by names that count from one another's folders
/// ("../meshes/chair.glb"). What lies below none of the folders, by dots or by links, is not there.
class ReachableFiles {
  public:
    /// `folders` are absolute and normal (model_library.h: foldersFor()).
    explicit ReachableFiles(std::vector<std::filesystem::path> folders)
        : folders_(std::move(folders)) {}

    [[nodiscard]] const std::vector<std::filesystem::path>& folders() const { return folders_; }

    /// The file that `name` means in a file of `folder`: the absolute path, or nothing.
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::filesystem::path& folder,
                                                            const std::string& name) const;

    /// Whether this file or folder exists below one of the folders. Below them no symbolic link is
    /// followed, and one is not reached itself.
    [[nodiscard]] bool reaches(const std::filesystem::path& path) const;

    /// The names of the files and folders in a folder that it reaches, sorted; links and names that
    /// begin with a dot are left out. Error: BadInput, where there are more than 100,000.
    [[nodiscard]] Result<std::vector<std::string>> namesIn(
        const std::filesystem::path& folder) const;

  private:
    std::vector<std::filesystem::path> folders_;
};

/// The absolute path without dots.
[[nodiscard]] std::filesystem::path absoluteNormal(const std::filesystem::path& path);

}  // namespace dollytrack::io
