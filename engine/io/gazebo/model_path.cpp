#include "engine/io/gazebo/model_path.h"

#include "engine/core/name_pattern.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/files/confined_folder.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/percent_text.h"
#include "engine/io/gazebo/fuel_uri.h"
#include "engine/io/gazebo/link_xml.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFoldersUp = 4;
constexpr std::uint64_t kMostConfigBytes = std::uint64_t{1} << 20U;

/// A folder and at most four folders above it, innermost first, without the file system's root.
std::vector<fs::path> foldersAround(const fs::path& folder) {
    std::vector<fs::path> around;
    fs::path at = folder;
    for (int up = 0; up <= kMostFoldersUp && at.has_relative_path(); ++up) {
        around.push_back(at);
        at = at.parent_path();
    }
    return around;
}

/// The package's name in a package.xml, or the description's file name in a model.config.
std::string nameIn(const fs::path& config) {
    const Result<std::string> text = readNamedFile(config, kMostConfigBytes);
    pugi::xml_document document;
    if (!text || !document.load_buffer(text->data(), text->size())) return {};
    if (const pugi::xml_node package = document.child("package")) {
        return textOf(package.child("name"));
    }
    // Of several versions the last one listed is the newest.
    std::string file;
    for (const pugi::xml_node& sdf : document.child("model").children("sdf")) file = textOf(sdf);
    return file;
}

/// Removes a scheme: "model://chair/chair.dae" becomes "chair/chair.dae", also with three slashes.
/// Returns whether `uri` had it.
bool takeScheme(std::string& uri, std::string_view scheme) {
    if (!uri.starts_with(scheme)) return false;
    const std::size_t path = uri.find_first_not_of('/', scheme.size());
    // A file's address may be an absolute path.
    uri.erase(0, scheme == "file://" ? scheme.size() : std::min(path, uri.size()));
    return true;
}

}  // namespace

std::optional<fs::path> ModelPath::find(const fs::path& folder, const std::string& uri) const {
    if (const auto fuel = fuelUriOf(uri)) {
        const auto downloaded = findFuelModel(files_, *fuel);
        return downloaded ? files_.find(*downloaded, fuel->file) : std::nullopt;
    }
    std::string name = percentDecoded(uri);
    const bool package = takeScheme(name, "package://");
    const bool model = !package && takeScheme(name, "model://");
    if (!package && !model) takeScheme(name, "file://");
    if (name.find("://") != std::string::npos) return std::nullopt;
    if (!package && !model) {
        if (auto found = files_.find(folder, name)) return found;
    }
    for (const fs::path& root : files_.folders()) {
        if (auto found = files_.find(root, name)) return found;
    }
    if (!package && !model)
        return fs::path(name).is_absolute() ? findByTail(folder, name) : std::nullopt;
    // The scene may be inside the model or package that it names: search the folders above it.
    const std::size_t slash = std::min(name.find('/'), name.size());
    const std::string within = name.substr(std::min(slash + 1, name.size()));
    const std::string owner = name.substr(0, slash);
    for (const fs::path& around : foldersAround(folder)) {
        if (auto found = files_.find(around, name)) return found;
        // A package's folder may have another name; package.xml contains the package's name.
        if (!package || within.empty()) continue;
        const auto xml = files_.find(around, "package.xml");
        const std::string called = xml ? nameOf(*xml) : std::string();
        if (!called.empty() && called != owner) return std::nullopt;
        if (auto found = files_.find(around, within)) return found;
        if (xml) return std::nullopt;
    }
    return std::nullopt;
}

std::optional<fs::path> ModelPath::findByTail(const fs::path& folder,
                                              const fs::path& absolute) const {
    constexpr std::size_t kLongest = 4096;
    constexpr std::size_t kMostNames = 16;
    if (absolute.native().size() > kLongest) return std::nullopt;
    const fs::path relative = absolute.relative_path();
    const std::vector<fs::path> names(relative.begin(), relative.end());
    std::vector<fs::path> roots = files_.folders();
    roots.push_back(folder);
    roots.push_back(folder.parent_path());
    // The name of a file alone is not enough.
    const std::size_t begin = names.size() - std::min(names.size(), kMostNames);
    for (std::size_t first = begin; first + 1 < names.size(); ++first) {
        fs::path tail;
        for (std::size_t i = first; i < names.size(); ++i) tail /= names[i];
        for (const fs::path& root : roots) {
            if (auto found = files_.find(root, tail.string())) return found;
        }
    }
    return std::nullopt;
}

std::vector<fs::path> ModelPath::rootsFor(const fs::path& folder) const {
    std::vector<fs::path> roots = files_.folders();
    for (const fs::path& around : foldersAround(folder)) {
        if (files_.reaches(around)) roots.push_back(around);
    }
    return roots;
}

std::vector<fs::path> ModelPath::filesIn(const fs::path& folder, const std::string& uri) const {
    std::string name = percentDecoded(uri);
    std::vector<fs::path> roots;
    if (const auto fuel = fuelUriOf(uri)) {
        const auto downloaded = findFuelModel(files_, *fuel);
        if (!downloaded) return {};
        roots.push_back(*downloaded);
        name = fuel->file;
    } else {
        if (isWebAddress(uri)) return {};
        const bool named = takeScheme(name, "package://") || takeScheme(name, "model://");
        if (!named) {
            takeScheme(name, "file://");
            roots.push_back(folder);  // first, as in find()
        }
        roots.insert(roots.end(), files_.folders().begin(), files_.folders().end());
        const std::vector<fs::path> above = foldersAround(folder);
        roots.insert(roots.end(), above.begin(), above.end());
    }
    std::vector<fs::path> files;
    const fs::path relative = fs::path(name).relative_path();
    if (relative.empty()) return files;
    for (const fs::path& root : roots) {
        const fs::path around = absoluteNormal(root / relative);
        const Result<std::vector<std::string>> names = files_.namesIn(around);
        if (!names || names->empty()) continue;
        for (const std::string& one : *names) files.push_back(around / one);
        return files;
    }
    if (const auto file = find(folder, uri)) files.push_back(*file);
    return files;
}

ModelPath::Absence ModelPath::absenceOf(const fs::path& folder, const std::string& uri) const {
    if (isWebAddress(uri)) return Absence::NoFolder;
    std::string name = percentDecoded(uri);
    for (const char* scheme : {"package://", "model://", "file://"}) takeScheme(name, scheme);
    Absence absence = Absence::NoFolder;
    const fs::path relative = fs::path(name).relative_path();
    for (const fs::path& root : rootsFor(folder)) {
        const fs::path around = absoluteNormal(root / relative.parent_path());
        if (!relative.has_parent_path() || !files_.reaches(around)) continue;
        absence = Absence::NoFile;
        const Result<std::vector<std::string>> names = files_.namesIn(around);
        if (!names) continue;
        const std::string wanted = inSmallLetters(relative.filename().string());
        if (std::ranges::any_of(*names,
                                [&](const auto& one) { return inSmallLetters(one) == wanted; })) {
            return Absence::OtherCase;
        }
    }
    return absence;
}

const std::string& ModelPath::nameOf(const fs::path& config) const {
    const auto [at, is_new] = names_.try_emplace(config);
    if (is_new) at->second = nameIn(config);
    return at->second;
}

std::optional<fs::path> ModelPath::findModel(const fs::path& folder, const std::string& uri) const {
    std::string name = uri;
    while (name.ends_with('/')) name.pop_back();
    if (const auto fuel = fuelUriOf(name); fuel && fuel->file.empty()) {
        const auto model = findFuelModel(files_, *fuel);
        if (!model) return std::nullopt;
        if (const auto config = files_.find(*model, "model.config")) {
            if (auto found = files_.find(*model, nameOf(*config))) return found;
        }
        return files_.find(*model, "model.sdf");
    }
    const std::string ending = lowerExtension(name);
    if (ending == ".sdf" || ending == ".urdf" || ending == ".world") return find(folder, name);
    if (const auto config = find(folder, name + "/model.config")) {
        if (auto found = files_.find(config->parent_path(), nameOf(*config))) return found;
    }
    return find(folder, name + "/model.sdf");
}

std::vector<fs::path> foldersOfWorld(const fs::path& scene, const ImportOptions& options) {
    const fs::path own = absoluteNormal(scene).parent_path();
    std::vector<fs::path> absolute;
    for (const fs::path& folder : options.model_folders) {
        absolute.push_back(absoluteNormal(folder));
    }
    std::vector<fs::path> folders =
        foldersFor(own / scene.filename(), absolute, {"models", "meshes", "media", "materials"});
    folders.insert(folders.begin(), own);
    if (hasFile(own / "model.config")) folders.push_back(own.parent_path());
    for (const fs::path& around : foldersAround(own)) {
        if (!hasFile(around / "package.xml")) continue;
        folders.push_back(around);
        break;
    }
    return folders;
}

}  // namespace dollytrack::gazebo
