#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/sandbox/cached_inputs.h"
#include "engine/io/sandbox/input_record.h"
#include "engine/io/sandbox/scene_frame.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::io {

/// Keeps what importers read, an entry a file. An entry counts as long as every file that the
/// reading opened has the same content, those it missed are still missing, and the folders it
/// searched hold the same names. Whatever is damaged, cut off or somebody else's is passed over.
class SceneCache {
  public:
    /// The user's, in the folder `scenes`, see userCache().
    [[nodiscard]] static std::optional<SceneCache> ofUser();

    /// So long a file has to have lain when it is hashed for its digest to be known from then on.
    static constexpr std::chrono::seconds kSettled{120};

    SceneCache(GuardedFolder folder, std::uint64_t most_bytes,
               std::chrono::seconds settled = kSettled)
        : folder_(std::move(folder)), most_bytes_(most_bytes), settled_(settled) {}

    /// The SHA-256 of a scene file. Large files are not hashed each time: a file that is the same
    /// by device, inode, size and both times has the digest that it had, provided that it had
    /// settled then, so that no write can have come within the same tick of the clock.
    [[nodiscard]] Result<std::string> digestOf(const std::filesystem::path& scene,
                                               const JobContext& job = {}) const;

    /// Names an entry by the content of the scene file, its extension, the options that matter to
    /// readers, the roots besides the scene's folder, and the readers themselves: the frame's
    /// version and the importer's file.
    [[nodiscard]] static std::string keyOf(const std::filesystem::path& scene,
                                           const std::string& sha256, const ImportOptions& options,
                                           const InputRoots& roots);

    /// The kept reading, checked like one that is handed back.
    [[nodiscard]] std::optional<ReadScene> find(const std::string& key,
                                                const InputRoots& roots) const;

    /// Keeps a frame, durably and whole or not at all; the oldest entries make room. False when
    /// it was not kept: too large, no room on the disk, an input that has changed since it was
    /// read or lies beneath none of the roots.
    bool keep(const std::string& key, const std::filesystem::path& scene, const std::string& sha256,
              const InputRoots& roots, const std::vector<InputUse>& inputs,
              std::span<const std::uint8_t> frame) const;

  private:
    GuardedFolder folder_;
    std::uint64_t most_bytes_;
    std::chrono::seconds settled_;
};

}  // namespace dollytrack::io
