#pragma once

#include "engine/core/result.h"
#include "engine/io/files/input_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack {

/// Opens the files that a scene names: only regular files below one folder. All readers use it.
/// Names that lead out of the folder, also by absolute paths or links, are refused, and so are
/// links in /proc, pipes and devices. Every access is noted in the InputRecord.
class ConfinedFolder {
  public:
    /// An empty path means the working directory. A missing folder contains no files.
    explicit ConfinedFolder(std::filesystem::path folder);

    /// Opens a file, given by its path relative to the folder. Errors: BadInput.
    [[nodiscard]] Result<InputFile> open(const std::filesystem::path& file) const;

    /// Whether open() would succeed. Only a missing file is noted in the InputRecord.
    [[nodiscard]] bool has(const std::filesystem::path& file) const;

    /// The regular files below the folder, as relative paths, by depth and then by name. At most
    /// five levels and 20,000 entries are searched; links are left out.
    [[nodiscard]] std::vector<std::filesystem::path> list() const;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

    /// The path relative to the folder, if it begins with the folder's path; otherwise the path
    /// itself.
    [[nodiscard]] std::string relative(const std::filesystem::path& file) const;

  private:
    [[nodiscard]] FileDescriptor openDescriptor(const std::string& relative) const;

    std::filesystem::path folder_;
};

/// Whether this regular file exists. A link counts only if its target lies below the file's own
/// folder.
[[nodiscard]] bool hasFile(const std::filesystem::path& file);

}  // namespace dollytrack
