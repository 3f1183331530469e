#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace dollytrack {

/// How much a finished write promises if the power fails.
enum class Durability {
    Synced,   // on the disk when the call returns
    Renamed,  // whole or absent to every reader; on the disk after the next syncFolder()
};

/// Writes a file whole or not at all: under a temporary name (`<name>.tmp.<pid>`) in the same
/// folder, renamed when everything is written. A file that was there stays until then. Errors are
/// CannotWrite and tell a full disk from missing permission and the like.
[[nodiscard]] Status writeWhole(const std::filesystem::path& path,
                                std::span<const std::uint8_t> bytes,
                                Durability durability = Durability::Synced);
[[nodiscard]] Status writeWhole(const std::filesystem::path& path, std::string_view text,
                                Durability durability = Durability::Synced);

/// Drops the ending `.tmp.<pid>` that writeWhole() gives to a file until it is complete. A name
/// without that ending is returned unchanged.
[[nodiscard]] std::string_view completedName(std::string_view name);

/// Writes all bytes to an open file, however many calls that takes. Returns 0 or errno.
[[nodiscard]] int writeAll(int descriptor, std::string_view bytes);

/// Brings everything written so far on the folder's file system to the disk.
[[nodiscard]] Status syncFolder(const std::filesystem::path& folder);

/// The sentence and code for a failed write or folder creation, from errno.
[[nodiscard]] Error writeError(int error_number, const std::filesystem::path& path);

}  // namespace dollytrack
