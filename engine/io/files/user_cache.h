#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace dollytrack::io {

/// A folder of the user's cache that can be written to, made if missing.
struct UserCache {
    std::filesystem::path folder;
    std::uint64_t most_bytes = 0;
};

/// $XDG_CACHE_HOME/dollytrack/<name>, else ~/.cache/dollytrack/<name>, of at most
/// $DOLLYTRACK_CACHE_MB (2048) MiB. Nothing when $DOLLYTRACK_NO_CACHE is set and not empty, or
/// there is no folder one can write to.
[[nodiscard]] std::optional<UserCache> userCache(const char* name);

}  // namespace dollytrack::io
