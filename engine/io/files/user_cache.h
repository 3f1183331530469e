#pragma once

#include "engine/io/files/guarded_folder.h"

#include <cstdint>
#include <optional>

namespace dollytrack {

/// A folder of the user's cache that can be written to, made if missing.
struct UserCache {
    GuardedFolder folder;
    std::uint64_t most_bytes = 0;
};

/// $XDG_CACHE_HOME/dollytrack/<name>, else ~/.cache/dollytrack/<name>, of at most
/// $DOLLYTRACK_CACHE_MB (2048) MiB. Nothing when $DOLLYTRACK_NO_CACHE is set and not empty, or
/// there is no folder one can write to: a symbolic link in the place of `dollytrack` or <name> is
/// not followed, and a warning says so.
[[nodiscard]] std::optional<UserCache> userCache(const char* name);

}  // namespace dollytrack
