#include "engine/io/pictures/texture_loader.h"

#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/percent_text.h"
#include "engine/io/pictures/picture_decoder.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestSide = 1024;
constexpr std::uint64_t kMostTextureFileBytes = std::uint64_t{1} << 29;

/// The file name of a path with slashes or backslashes, such as "C:\maps\Wood.PNG".
std::string baseName(const std::string& name) {
    const auto slash = name.find_last_of("/\\");
    return slash == std::string::npos ? name : name.substr(slash + 1);
}

/// An index of the files in a texture folder.
struct PictureFolder {
    explicit PictureFolder(const fs::path& folder) : files(folder) {
        for (const fs::path& file : files.list()) {
            by_name[inSmallLetters(file.filename().string())].push_back(file);
        }
    }
    ConfinedFolder files;
    std::map<std::string, std::vector<fs::path>> by_name;  // in small letters; least nested first
};

/// The number of folders above the file in which two paths agree, counted from the file upwards.
std::ptrdiff_t sharedFolders(const fs::path& one, const fs::path& other) {
    const auto foldersOf = [](const fs::path& path) {
        std::vector<std::string> folders;
        for (const fs::path& part : path.parent_path()) {
            folders.push_back(inSmallLetters(part.string()));
        }
        std::ranges::reverse(folders);
        return folders;
    };
    const std::vector<std::string> folders = foldersOf(one);
    return std::ranges::mismatch(folders, foldersOf(other)).in1 - folders.begin();
}

std::optional<fs::path> locate(const std::string& name, bool only_there,
                               const PictureFolder& folder) {
    for (const std::string& spelling : {name, percentDecoded(name)}) {
        std::string relative = spelling;
        std::replace(relative.begin(), relative.end(), '\\', '/');
        const fs::path direct = fs::path(relative).lexically_normal();
        // For a path that leaves the folder, only the file name is used.
        if (direct.is_relative() && !direct.empty() && *direct.begin() != ".." &&
            folder.files.has(direct)) {
            return direct;
        }
        if (only_there) continue;
        const auto found = folder.by_name.find(inSmallLetters(baseName(relative)));
        if (found == folder.by_name.end()) continue;
        // Of files with the same name, the one whose folders agree with those of the path.
        return *std::ranges::max_element(
            found->second, {}, [&](const fs::path& file) { return sharedFolders(file, direct); });
    }
    return std::nullopt;
}

std::string readBytes(const ConfinedFolder& folder, const fs::path& path) {
    const Result<InputFile> file = folder.open(path);
    if (!file) return {};
    Result<std::string> bytes = file->readAll(kMostTextureFileBytes);
    return bytes ? std::move(*bytes) : std::string();
}

}  // namespace

void shareTextures(RawScene& scene) {
    using File = std::tuple<std::string, fs::path, bool>;
    std::map<File, int> first;
    std::vector<int> shared;
    std::vector<TextureRequest> kept;
    for (TextureRequest& request : scene.textures) {
        int index = static_cast<int>(kept.size());
        if (request.embedded.empty()) {
            const auto [found, is_new] =
                first.try_emplace({request.name, request.folder, request.only_there}, index);
            index = found->second;
            if (!is_new) kept[static_cast<std::size_t>(index)].opaque &= request.opaque;
        }
        shared.push_back(index);
        if (index == static_cast<int>(kept.size())) kept.push_back(std::move(request));
    }
    for (Material& material : scene.materials) {
        visitTextures(material, [&](int& index) {
            if (index >= 0 && index < static_cast<int>(shared.size())) {
                index = shared[static_cast<std::size_t>(index)];
            }
        });
    }
    scene.textures = std::move(kept);
}

TextureSet loadTextures(const fs::path& scene_path, const std::vector<TextureRequest>& requests,
                        const std::vector<fs::path>& more_folders, const JobContext& job) {
    TextureSet set;
    set.textures.resize(requests.size());
    if (requests.empty()) return set;
    fs::path beside = scene_path.parent_path();
    if (beside.empty()) beside = ".";
    const auto folderOf = [&](const TextureRequest& request) {
        return request.folder.empty() ? beside : request.folder;
    };
    std::map<fs::path, PictureFolder> folders;
    for (const TextureRequest& request : requests) {
        if (!request.embedded.empty()) continue;
        folders.try_emplace(folderOf(request), folderOf(request));
    }
    // The other folders may be large, so they are listed only if a texture is missing.
    const auto isMissing = [&](const TextureRequest& request) {
        return request.embedded.empty() && !request.only_there &&
               !locate(request.name, false, folders.at(folderOf(request)));
    };
    if (!more_folders.empty() && std::ranges::any_of(requests, isMissing)) {
        for (const fs::path& folder : more_folders) folders.try_emplace(folder, folder);
    }

    enum class State { Missing, Broken, Found };
    std::vector<State> states(requests.size(), State::Missing);
    parallelFor(requests.size(), [&](std::size_t i) {
        const TextureRequest& request = requests[i];
        Texture& texture = set.textures[i];
        texture.name = cleanText(request.name);
        if (job.cancelled()) return;
        if (request.embedded_width > 0) {
            texture.width = request.embedded_width;
            texture.height = request.embedded_height;
            texture.rgba = request.embedded;
            states[i] = State::Found;
            return;
        }
        std::string bytes;
        std::span<const std::uint8_t> picture = request.embedded;
        if (picture.empty()) {
            const PictureFolder* place = &folders.at(folderOf(request));
            auto path = locate(request.name, request.only_there, *place);
            for (std::size_t k = 0; !path && !request.only_there && k < more_folders.size(); ++k) {
                place = &folders.at(more_folders[k]);
                path = locate(request.name, false, *place);
            }
            if (!path) return;
            bytes = readBytes(place->files, *path);
            picture = {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
        }
        const bool whole = decodePicture(picture, kLargestSide, request.opaque, texture);
        states[i] = whole ? State::Found : State::Broken;
    });
    for (std::size_t i = 0; i < requests.size(); ++i) {
        if (states[i] == State::Found) ++set.found;
        if (states[i] == State::Missing) set.missing.push_back(set.textures[i].name);
        if (states[i] == State::Broken) set.broken.push_back(set.textures[i].name);
    }
    return set;
}

}  // namespace dollytrack
