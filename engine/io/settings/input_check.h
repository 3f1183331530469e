#pragma once

#include "engine/core/result.h"

#include <filesystem>

namespace dollytrack {

struct SceneFormat;

/// Cheap tests before a model reader sees the file: it exists, is a file with something in it, has
/// an extension we read and the first bytes that go with it, and is no Git-LFS pointer. Returns
/// how it is to be read.
Result<const SceneFormat*> checkSceneFile(const std::filesystem::path& path);

}  // namespace dollytrack
