#include "engine/io/cache_room.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <system_error>
#include <vector>

namespace dollytrack::io {

void makeCacheRoom(const std::filesystem::path& folder,
                   std::initializer_list<std::string_view> endings, std::uint64_t most_bytes) {
    namespace fs = std::filesystem;
    struct Old {
        fs::file_time_type time;
        fs::path path;
        std::uint64_t size;
    };
    std::vector<Old> entries;
    std::error_code error;
    const auto now = fs::file_time_type::clock::now();
    fs::directory_iterator it(folder, error);
    for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
        std::error_code gone;
        if (!it->is_regular_file(gone) || it->is_symlink(gone)) continue;
        const auto time = it->last_write_time(gone);
        const std::string name = it->path().filename().string();
        const auto ends_so = [&](std::string_view ending) { return name.ends_with(ending); };
        const auto half_written = [&](std::string_view ending) {
            return name.find(std::string(ending) + ".tmp.") != std::string::npos;
        };
        if (std::ranges::any_of(endings, ends_so)) {
            const std::uint64_t size = it->file_size(gone);
            if (!gone) entries.push_back({time, it->path(), size});
        } else if (std::ranges::any_of(endings, half_written) &&
                   now - time > std::chrono::hours(1)) {
            fs::remove(it->path(), gone);
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Old& a, const Old& b) {
        return a.time != b.time ? a.time < b.time : a.path < b.path;
    });
    std::uint64_t total = 0;
    for (const Old& entry : entries) total += entry.size;
    for (const Old& entry : entries) {
        if (total <= most_bytes) break;
        fs::remove(entry.path, error);
        total -= entry.size;
    }
}

}  // namespace dollytrack::io
