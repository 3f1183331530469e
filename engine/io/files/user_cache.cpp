#include "engine/io/files/user_cache.h"

#include "engine/core/log.h"

#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kDefaultMebibytes = 2048;

fs::path cacheHome() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    // The XDG specification requires an absolute path; others must be ignored.
    if (cache != nullptr && *cache == '/') return cache;
    if (home != nullptr && *home == '/') return fs::path(home) / ".cache";
    return {};
}

std::uint64_t userMebibytes() {
    const char* given = std::getenv("DOLLYTRACK_CACHE_MB");
    const std::string_view text = given != nullptr ? given : "";
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    constexpr std::uint64_t kMost = std::uint64_t{1} << 24U;
    return error == std::errc() && number <= kMost ? number : kDefaultMebibytes;
}

}  // namespace

std::optional<UserCache> userCache(const char* name) {
    const char* off = std::getenv("DOLLYTRACK_NO_CACHE");
    if (off != nullptr && *off != '\0') return std::nullopt;
    const fs::path home = cacheHome();
    const std::uint64_t mebibytes = userMebibytes();
    if (home.empty() || mebibytes == 0) return std::nullopt;
    Result<GuardedFolder> folder = GuardedFolder::makeBelow(home / "dollytrack" / name, home);
    if (!folder) {
        std::error_code error;
        if (fs::is_symlink(folder.error().where, error)) {
            log::warn("cache", describe(folder.error()) + "; nothing is cached there");
        }
        return std::nullopt;
    }
    if (::access(folder->path().c_str(), R_OK | W_OK | X_OK) != 0) return std::nullopt;
    return UserCache{std::move(*folder), mebibytes << 20U};
}

}  // namespace dollytrack
