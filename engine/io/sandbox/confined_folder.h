#pragma once

#include "engine/core/result.h"
#include "engine/io/sandbox/input_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::io {

/// The one door through which readers open the files that a scene names: only regular files
/// beneath one folder. Names that lead out of it, absolute ones and links included, are refused,
/// and so are /proc's links, pipes and devices. What goes through it is noted in the InputRecord.
class ConfinedFolder {
  public:
    /// An empty path is the working directory. A folder that is not there holds no files.
    explicit ConfinedFolder(std::filesystem::path folder);

    /// `file` counts from the folder, or begins with the folder's own path. Errors: BadInput.
    [[nodiscard]] Result<InputFile> open(const std::filesystem::path& file) const;

    /// Whether open() would succeed; nothing is noted but that a file is missing.
    [[nodiscard]] bool has(const std::filesystem::path& file) const;

    /// The regular files beneath it, as paths from it, in order of depth and name: five levels,
    /// at most 20,000 entries, links left out.
    [[nodiscard]] std::vector<std::filesystem::path> list() const;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  private:
    /// The part of `file` that counts from the folder; nothing when it does not lie beneath it.
    [[nodiscard]] std::string relative(const std::filesystem::path& file) const;
    [[nodiscard]] FileDescriptor openDescriptor(const std::string& relative) const;

    std::filesystem::path folder_;
};

/// Whether there is this regular file, and no link that leads out of the file's own folder.
[[nodiscard]] bool hasFile(const std::filesystem::path& file);

}  // namespace dollytrack::io
