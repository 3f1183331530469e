#include "app/batch/scene_files.h"

#include "app/batch/file_pattern.h"
#include "engine/core/clean_text.h"
#include "engine/core/natural_order.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/reachable_files.h"
#include "engine/io/format_table/scene_format.h"
#include "engine/io/habitat/config_choice.h"
#include "engine/io/habitat/habitat_reader.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <system_error>
#include <utility>

namespace dollytrack::batch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAnyFolders = "**";

/// File types that a wildcard selects; scene folders also contain textures and materials.
bool isScene(const fs::path& path) {
    return lowerExtension(path) == ".dolly" || isSceneFile(path);
}

using Parts = std::vector<std::string>;

Parts partsOf(const fs::path& path) {
    Parts parts;
    for (const fs::path& part : path) {
        if (!part.empty()) parts.push_back(part.string());
    }
    return parts;
}

struct Entry {
    std::string name;
    bool folder = false;
};

Result<std::vector<Entry>> entriesOf(const fs::path& folder) {
    std::vector<Entry> entries;
    std::error_code error;
    fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error);
    for (; !error && at != fs::directory_iterator(); at.increment(error)) {
        std::error_code unknown;  // dangling links are neither file nor folder
        entries.push_back({at->path().filename().string(), at->is_directory(unknown)});
    }
    if (error) {
        return fail(ErrorCode::BadInput, "the folder cannot be read (" + error.message() + ")",
                    folder.string());
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return comesBefore(a.name, b.name); });
    return entries;
}

class Search {
  public:
    Search(fs::path base, Parts parts) : base_(std::move(base)), parts_(std::move(parts)) {}

    /// Searches `folder` (relative to the base) for matches of the pattern's parts from index `at`
    /// on. With several "**", the same folder and part can be reached repeatedly; repetitions are
    /// skipped.
    Status look(const fs::path& folder, std::size_t at) {
        if (!looked_.insert({folder.string(), at}).second) return {};
        if (looked_.size() > kMostLooks) {
            return fail(ErrorCode::BadInput,
                        fmt::format("the pattern matches more than {} folders; use a narrower one",
                                    kMostLooks),
                        folder.string());
        }
        const bool any_depth = parts_[at] == kAnyFolders;
        if (any_depth && at + 1 < parts_.size()) {
            if (Status status = look(folder, at + 1); !status) return status;
        }
        const Result<std::vector<Entry>> entries = entriesOf(base_ / folder);
        if (!entries) return tl::unexpected(entries.error());
        for (const Entry& entry : *entries) {
            Status status;
            if (any_depth) {
                // Links are not followed: they may form cycles.
                const bool link = fs::is_symlink(base_ / folder / entry.name);
                if (entry.folder && !link && entry.name.front() != '.') {
                    status = look(folder / entry.name, at);
                }
            } else if (fitsFilePattern(entry.name, parts_[at])) {
                const bool last = at + 1 == parts_.size();
                if (last && !entry.folder && isScene(base_ / folder / entry.name)) {
                    found_.push_back({folder / entry.name, {}});
                } else if (!last && entry.folder) {
                    status = look(folder / entry.name, at + 1);
                }
            }
            if (!status) return status;
        }
        return {};
    }

    std::vector<SceneFile> take() { return std::move(found_); }

  private:
    static constexpr std::size_t kMostLooks = 200'000;

    fs::path base_;
    Parts parts_;
    std::set<std::pair<std::string, std::size_t>> looked_;
    std::vector<SceneFile> found_;
};

/// Whether the path's names match the pattern's parts; "**" matches any number of names.
bool fitAll(const Parts& names, const Parts& parts) {
    // fit[i]: the first i names match the parts so far.
    std::vector<char> fit(names.size() + 1, 0);
    fit[0] = 1;
    for (const std::string& part : parts) {
        std::vector<char> next(names.size() + 1, 0);
        for (std::size_t i = 0; i <= names.size(); ++i) {
            if (part == kAnyFolders) {
                next[i] = fit[i] != 0 || (i > 0 && next[i - 1] != 0) ? 1 : 0;
            } else if (i > 0 && fit[i - 1] != 0 && fitsFilePattern(names[i - 1], part)) {
                next[i] = 1;
            }
        }
        fit = std::move(next);
    }
    return fit.back() != 0;
}

constexpr std::size_t kLongestName = 64;  // bytes, without set, planner and seed

/// Truncates to kLongestName bytes, without splitting a UTF-8 character.
std::string cutName(std::string name) {
    std::size_t end = std::min(name.size(), kLongestName);
    while (end < name.size() && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
    name.resize(end);
    return name;
}

/// Whether a file name is generic, as in data sets with one folder per scene.
bool saysNothing(std::string stem) {
    std::ranges::transform(stem, stem.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array<std::string_view, 5> kStems = {"scene", "model", "mesh", "home",
                                                        "untitled"};
    return std::ranges::find(kStems, stem) != kStems.end();
}

/// Parts of a scene's path that can become part of its name.
struct NameParts {
    Parts folders;  // from the innermost
    std::string own;
    std::string ending;
};

NameParts namePartsOf(const fs::path& path) {
    NameParts parts;
    parts.own = path.stem().string();
    // "apt_0.scene_instance.json" is called "apt_0".
    for (const std::string_view kind : {".scene_instance", ".stage_config"}) {
        if (parts.own.ends_with(kind)) parts.own.resize(parts.own.size() - kind.size());
    }
    if (path.has_extension()) parts.ending = path.extension().string().substr(1);
    for (const std::string& folder : partsOf(path.parent_path())) {
        if (folder != "." && folder != ".." && folder != "/") {
            parts.folders.insert(parts.folders.begin(), folder);
        }
    }
    if (saysNothing(parts.own) && !parts.folders.empty()) {
        parts.own = parts.folders.front();
        parts.folders.erase(parts.folders.begin());
    }
    return parts;
}

std::string nameWith(const NameParts& parts, std::size_t folders, bool with_ending) {
    std::string name = parts.own;
    for (std::size_t i = 0; i < std::min(folders, parts.folders.size()); ++i) {
        name.insert(0, parts.folders[i] + "_");
    }
    return cutName(asName(with_ending ? name + "_" + parts.ending : name));
}

/// The shortest names that distinguish these scenes, if any do.
std::vector<std::string> namesApart(std::vector<NameParts> alike) {
    // Common outer folders do not distinguish them.
    const auto sharesOutermost = [&](const NameParts& one) {
        return !one.folders.empty() && !alike.front().folders.empty() &&
               one.folders.back() == alike.front().folders.back();
    };
    while (std::ranges::all_of(alike, sharesOutermost)) {
        for (NameParts& one : alike) one.folders.pop_back();
    }
    std::size_t most = 0;
    for (const NameParts& one : alike) most = std::max(most, one.folders.size());
    std::vector<std::string> names;
    for (std::size_t folders = 0; folders <= most; ++folders) {
        for (const bool with_ending : {false, true}) {
            names.clear();
            for (const NameParts& one : alike) {
                names.push_back(nameWith(one, folders, with_ending));
            }
            if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) {
                return names;
            }
        }
    }
    return names;
}

/// Replaces Habitat dataset configs by the scenes they list. Several configs may list the same
/// scene.
Result<std::vector<SceneFile>> withDatasetScenes(std::vector<SceneFile> files,
                                                 const fs::path& base) {
    const fs::path root = absoluteNormal(base.empty() ? fs::path(".") : base);
    std::vector<SceneFile> all;
    std::set<fs::path> added;
    const auto add = [&](SceneFile file) {
        if (added.insert(absoluteNormal(root / file.path)).second) {
            all.push_back(std::move(file));
        }
    };
    std::vector<fs::path> configs;
    for (const SceneFile& file : files) {
        if (habitat::isDatasetConfig(file.path)) {
            configs.push_back(absoluteNormal(root / file.path));
        }
    }
    for (SceneFile& file : files) {
        if (!habitat::isDatasetConfig(file.path)) {
            add(std::move(file));
            continue;
        }
        const auto scenes = habitat::scenesOfDataset(base / file.path, configs);
        if (!scenes) return tl::unexpected(scenes.error());
        for (const fs::path& scene : *scenes) {
            const fs::path relative = scene.lexically_relative(root);
            add({file.path.is_absolute() || relative.empty() ? scene : relative, {}});
        }
    }
    return all;
}

}  // namespace

bool isPattern(const std::string& text) {
    return text.find_first_of("*?[") != std::string::npos;
}

Result<std::vector<SceneFile>> filesMatching(const std::string& pattern, const fs::path& base) {
    const fs::path path = fs::path(pattern).lexically_normal();
    if (!isPattern(pattern)) {
        std::error_code error;
        if (!fs::exists(base / path, error)) {
            return fail(ErrorCode::BadInput, "there is no file '" + pattern + "'");
        }
        return withDatasetScenes(std::vector<SceneFile>{{path, {}}}, base);
    }
    // Leading folders without wildcards are entered directly.
    Parts parts = partsOf(path);
    fs::path folder;
    std::size_t fixed = 0;
    while (fixed + 1 < parts.size() && !isPattern(parts[fixed])) folder /= parts[fixed++];
    parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(fixed));
    if (parts.back() == kAnyFolders) parts.emplace_back("*");
    Search search(base, std::move(parts));
    if (Status status = search.look(folder, 0); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    std::vector<SceneFile> found = search.take();
    if (found.empty()) {
        return fail(ErrorCode::BadInput,
                    fmt::format("'{}' matches no scene; scenes are {} and .dolly files", pattern,
                                fmt::join(sceneExtensions(), ", ")));
    }
    return withDatasetScenes(std::move(found), base);
}

bool matches(const fs::path& path, const std::string& pattern) {
    return fitAll(partsOf(path.lexically_normal()), partsOf(fs::path(pattern).lexically_normal()));
}

void nameScenes(std::vector<SceneFile>& scenes) {
    std::map<std::string, std::vector<std::size_t>> by_name;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        by_name[nameWith(namePartsOf(scenes[i].path), 0, false)].push_back(i);
    }
    for (const auto& [name, indices] : by_name) {
        std::vector<NameParts> alike;
        for (const std::size_t i : indices) alike.push_back(namePartsOf(scenes[i].path));
        const std::vector<std::string> names = namesApart(alike);
        for (std::size_t i = 0; i < indices.size(); ++i) scenes[indices[i]].name = names[i];
    }
    // Number the remaining equal names: paths that differ only in replaced or truncated characters.
    std::set<std::string> all;
    for (const SceneFile& scene : scenes) all.insert(scene.name);
    std::set<std::string> used;
    std::map<std::string, int> next;  // by name, the next number to try
    for (SceneFile& scene : scenes) {
        const std::string name = scene.name;
        int& i = next.try_emplace(name, 2).first->second;
        for (; used.contains(scene.name); ++i) {
            const std::string numbered = fmt::format("{}-{}", name, i);
            if (!all.contains(numbered)) scene.name = numbered;
        }
        used.insert(scene.name);
    }
}

std::string asName(std::string_view text) {
    std::string name;
    for (const char c : cleanText(text)) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte >= 128 || std::isalnum(byte) != 0 || c == '-' || c == '_';
        if (plain) {
            name += c;
        } else if (!name.empty() && name.back() != '_') {
            name += '_';
        }
    }
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name.empty() ? "scene" : name;
}

}  // namespace dollytrack::batch
