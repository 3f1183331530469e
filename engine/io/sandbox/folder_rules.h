#pragma once

#include <filesystem>
#include <vector>

namespace dollytrack {

/// Applies Landlock rules: from now on this process can read only files and folders below
/// `readable` (folders or files), and can neither write, create, remove, execute nor connect to
/// anything. Returns false if the kernel has no Landlock or it is disabled.
[[nodiscard]] bool lockIntoFolders(const std::vector<std::filesystem::path>& readable);

}  // namespace dollytrack
