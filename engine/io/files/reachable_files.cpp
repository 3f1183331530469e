#include "engine/io/files/reachable_files.h"

#include "engine/io/files/confined_folder.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/input_record.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> pathBelow(const fs::path& folder, const fs::path& path) {
    const fs::path below = path.lexically_relative(folder);
    if (below.empty() || *below.begin() == "..") return std::nullopt;
    return below;
}

}  // namespace

fs::path absoluteNormal(const fs::path& path) {
    std::error_code error;
    fs::path normal = fs::absolute(path, error).lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

std::optional<fs::path> ReachableFiles::find(const fs::path& folder,
                                             const std::string& name) const {
    if (name.empty() || name.size() > 4096 || name.find('\0') != std::string::npos) {
        return std::nullopt;
    }
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    const fs::path file = (folder / slashes).lexically_normal();
    for (const fs::path& root : folders_) {
        const auto below = pathBelow(root, file);
        if (below && *below != "." && ConfinedFolder(root).has(*below)) return file;
    }
    return std::nullopt;
}

std::vector<ReachableFiles::Place> ReachableFiles::placesOf(const fs::path& path) const {
    const fs::path normal = absoluteNormal(path);
    std::vector<Place> places;
    for (const fs::path& root : folders_) {
        if (auto below = pathBelow(root, normal)) places.push_back({root, std::move(*below)});
    }
    return places;
}

bool ReachableFiles::exists(const Place& place) {
    const Result<GuardedFolder> folder = GuardedFolder::open(place.root);
    if (!folder || place.below == ".") return folder.has_value();
    const auto found = folder->find(place.below.string());
    return found && !S_ISLNK(found->st_mode);
}

bool ReachableFiles::reaches(const fs::path& path) const {
    return std::ranges::any_of(placesOf(path), exists);
}

Result<std::vector<std::string>> ReachableFiles::namesIn(const fs::path& folder) const {
    constexpr std::size_t kMost = 100'000;
    std::vector<std::string> names;
    const std::vector<Place> places = placesOf(folder);
    // A missing folder is recorded too, because the scene depends on whether it exists.
    if (!places.empty()) InputRecord::note(InputUse::Listing, folder);
    if (std::ranges::none_of(places, exists)) return names;
    std::error_code error;
    fs::directory_iterator at(folder, error);
    for (const fs::directory_iterator end; !error && at != end; at.increment(error)) {
        std::error_code unknown;
        const std::string name = at->path().filename().string();
        if (name.starts_with('.') || at->is_symlink(unknown)) continue;
        if (names.size() >= kMost) {
            return fail(ErrorCode::BadInput,
                        "the folder contains more than 100,000 files; split it", folder.string());
        }
        names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace dollytrack
