#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace dollytrack::render {

/// Takes possession of an output folder before anything is drawn: creates it and its subfolders,
/// tries a write, and removes what an earlier dataset left there, dataset.json first. A folder that
/// holds other things is refused unless `overwrite`; they are never removed. `bytes_needed` is
/// compared with the free space.
[[nodiscard]] Status prepareDatasetFolder(const std::filesystem::path& folder, bool overwrite,
                                          std::uint64_t bytes_needed);

/// Marks the folder as complete. Call last.
[[nodiscard]] Status releaseDatasetFolder(const std::filesystem::path& folder);

/// "rgb/000012.png"
[[nodiscard]] std::string frameFile(const std::string& subfolder, int index);

/// A guess, on the high side of furnished rooms.
[[nodiscard]] std::uint64_t estimateBytes(int frames, int width, int height);

}  // namespace dollytrack::render
