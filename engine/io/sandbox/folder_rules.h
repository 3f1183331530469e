#pragma once

#include <filesystem>
#include <vector>

namespace dollytrack {

/// Folders or files that a process may use, with everything below them.
struct FolderRights {
    std::vector<std::filesystem::path> readable;
    std::vector<std::filesystem::path> executable = {};  // readable, too
    std::vector<std::filesystem::path> writable = {};    // all but execution
};

/// Applies Landlock rules: from now on this process and its children can read, execute, write,
/// create and remove only what `rights` say, and cannot connect to anything by TCP. Returns false
/// if the kernel has no Landlock or it is disabled.
[[nodiscard]] bool lockIntoFolders(const FolderRights& rights);

}  // namespace dollytrack
