#pragma once

#include "engine/core/result.h"

#include <filesystem>

namespace dollytrack {

struct SceneFormat;

/// Quick checks before a file is read: it must be a non-empty file with a supported extension and
/// matching first bytes, and not a Git LFS pointer. Returns its format. Error: BadInput, with what
/// to do for known unsupported formats.
Result<const SceneFormat*> checkSceneFile(const std::filesystem::path& path);

}  // namespace dollytrack
