#pragma once

#include <filesystem>
#include <vector>

namespace dollytrack::io {

/// Landlock: from now on this process reads files and folders beneath `readable` (which may be
/// files, too), and can neither write, create, remove, run nor connect anything. False where the
/// kernel has no Landlock or it is switched off.
[[nodiscard]] bool lockIntoFolders(const std::vector<std::filesystem::path>& readable);

}  // namespace dollytrack::io
