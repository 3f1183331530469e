#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace dollytrack::render {

/// Takes possession of an output folder before anything is drawn: creates it and its subfolders,
/// tries a write, and removes what an earlier dataset left there, dataset.json first. A folder with
/// anything in it, but neither a dataset.json of ours nor our mark, is refused unless `overwrite`;
/// then only files named like a dataset's are removed. `bytes_needed` is compared with the free
/// space.
[[nodiscard]] Status prepareDatasetFolder(const std::filesystem::path& folder, bool overwrite,
                                          std::uint64_t bytes_needed);

/// Marks the folder as complete. Call last.
[[nodiscard]] Status releaseDatasetFolder(const std::filesystem::path& folder);

/// "rgb/000012.png"
[[nodiscard]] std::string frameFile(const std::string& subfolder, int index);

/// A guess, on the high side of furnished rooms.
[[nodiscard]] std::uint64_t estimateBytes(int frames, int width, int height);

}  // namespace dollytrack::render
