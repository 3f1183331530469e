#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/input_record.h"
#include "engine/io/sandbox/cached_inputs.h"
#include "engine/io/sandbox/scene_serialization.h"
#include "engine/io/settings/import_options.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dollytrack {

/// A cache of importers' readings, one file for each. An entry is valid as long as every file that
/// was opened has the same content, files that were missing are still missing, and folders that
/// were searched hold the same names. Entries that are damaged, truncated or owned by another user
/// are ignored.
class SceneCache {
  public:
    /// The user's cache, in the folder `scenes` of userCache().
    [[nodiscard]] static std::optional<SceneCache> ofUser();

    /// A stored hash is trusted while the file's times and size stay the same, if the file had not
    /// been changed for this long before it was hashed.
    static constexpr std::chrono::seconds kSettled{120};

    SceneCache(GuardedFolder folder, std::uint64_t most_bytes,
               std::chrono::seconds settled = kSettled)
        : folder_(std::move(folder)), most_bytes_(most_bytes), settled_(settled) {}

    /// The SHA-256 of a scene file. To avoid hashing large files each time, digests are stored: a
    /// stored digest is reused if device, inode, size and both times of the file are the same and
    /// the file was old enough when it was hashed (kSettled). A younger file could change again
    /// without a change of its time stamps.
    [[nodiscard]] Result<std::string> digestOf(const std::filesystem::path& scene,
                                               const JobContext& job = {}) const;

    /// The name of an entry. It depends on everything that decides a reading: the scene file's
    /// content and extension, the options that matter to readers, the roots besides the scene's
    /// folder, the serialization version and the importer's program file.
    [[nodiscard]] static std::string keyOf(const std::filesystem::path& scene,
                                           const std::string& sha256, const ImportOptions& options,
                                           const InputRoots& roots);

    /// The cached reading, checked like one that an importer hands back.
    [[nodiscard]] std::optional<DecodedScene> find(const std::string& key,
                                                   const InputRoots& roots) const;

    /// Stores a serialized scene, durably and completely or not at all; the oldest entries are
    /// removed to make room. Returns false if it was not stored: it is too large, the disk is full,
    /// or an input was changed since it was read or lies below none of the roots.
    bool keep(const std::string& key, const std::filesystem::path& scene, const std::string& sha256,
              const InputRoots& roots, const std::vector<InputUse>& inputs,
              std::span<const std::uint8_t> serialized) const;

  private:
    GuardedFolder folder_;
    std::uint64_t most_bytes_;
    std::chrono::seconds settled_;
};

}  // namespace dollytrack
