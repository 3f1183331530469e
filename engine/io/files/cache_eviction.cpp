#include "engine/io/files/cache_eviction.h"

#include "engine/io/files/durable_file.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include <ctime>

namespace dollytrack {

void evictOldest(const GuardedFolder& folder, std::initializer_list<std::string_view> endings,
                 std::uint64_t most_bytes) {
    constexpr std::time_t kHour_s = 3600;
    struct Old {
        std::time_t time_s;
        long time_ns;
        std::string name;
        std::uint64_t size;
    };
    std::vector<Old> entries;
    for (const std::string& name : folder.list("").value_or(std::vector<std::string>())) {
        const auto found = folder.find(name);
        if (!found || !S_ISREG(found->st_mode)) continue;
        const std::string_view completed = completedName(name);
        const auto has_ending = [&](std::string_view ending) {
            return completed.ends_with(ending);
        };
        if (!std::ranges::any_of(endings, has_ending)) continue;
        if (completed == name) {
            entries.push_back({found->st_mtim.tv_sec, found->st_mtim.tv_nsec, name,
                               static_cast<std::uint64_t>(found->st_size)});
        } else if (std::time(nullptr) - found->st_mtim.tv_sec > kHour_s) {
            (void)folder.remove(name);
        }
    }
    std::ranges::sort(entries, {}, [](const Old& entry) {
        return std::tie(entry.time_s, entry.time_ns, entry.name);
    });
    std::uint64_t total = 0;
    for (const Old& entry : entries) total += entry.size;
    for (const Old& entry : entries) {
        if (total <= most_bytes) break;
        (void)folder.remove(entry.name);
        total -= entry.size;
    }
}

}  // namespace dollytrack
