#include "engine/io/gazebo/fuel_uri.h"

#include "engine/core/name_pattern.h"
#include "engine/io/files/percent_text.h"

#include <algorithm>
#include <array>
#include <vector>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

/// The components of a path.
std::vector<std::string> stepsOf(std::string_view path) {
    std::vector<std::string> parts;
    while (!path.empty()) {
        const std::size_t slash = std::min(path.find('/'), path.size());
        if (slash > 0) parts.emplace_back(path.substr(0, slash));
        path.remove_prefix(std::min(slash + 1, path.size()));
    }
    return parts;
}

bool isVersionNumber(const std::string& text) {
    return !text.empty() && text.size() < 10 &&
           text.find_first_not_of("0123456789") == std::string::npos;
}

/// The subfolder with this name; case does not count.
std::optional<fs::path> folderIn(const ReachableFiles& files, const fs::path& folder,
                                 const std::string& name) {
    const auto names = files.namesIn(folder);
    if (!names) return std::nullopt;
    const std::string small = inSmallLetters(name);
    for (const std::string& one : *names) {
        if (inSmallLetters(one) == small) return folder / one;
    }
    return std::nullopt;
}

bool isModelFolder(const ReachableFiles& files, const fs::path& folder) {
    return files.find(folder, "model.config").has_value() ||
           files.find(folder, "model.sdf").has_value();
}

/// The folder of a version; without a version, of the newest one that exists.
std::optional<fs::path> versionIn(const ReachableFiles& files, const fs::path& model,
                                  const std::string& version) {
    if (!version.empty()) {
        const fs::path folder = model / version;
        return isModelFolder(files, folder) ? std::optional(folder) : std::nullopt;
    }
    const auto names = files.namesIn(model);
    if (!names) return std::nullopt;
    std::optional<fs::path> newest;
    int number = -1;
    for (const std::string& name : *names) {
        if (!isVersionNumber(name) || std::stoi(name) <= number) continue;
        if (!isModelFolder(files, model / name)) continue;
        number = std::stoi(name);
        newest = model / name;
    }
    return newest;
}

}  // namespace

bool isWebAddress(std::string_view uri) {
    return uri.starts_with("http://") || uri.starts_with("https://");
}

std::optional<FuelUri> fuelUriOf(const std::string& uri) {
    if (!isWebAddress(uri)) return std::nullopt;
    std::vector<std::string> parts = stepsOf(percentDecoded(uri.substr(uri.find("://") + 3)));
    static constexpr std::array<std::string_view, 4> kServers = {
        "fuel.gazebosim.org", "fuel.ignitionrobotics.org", "app.gazebosim.org",
        "app.ignitionrobotics.org"};
    if (parts.empty() || std::ranges::find(kServers, inSmallLetters(parts[0])) == kServers.end()) {
        return std::nullopt;
    }
    FuelUri found;
    found.server = inSmallLetters(parts[0]);
    // "1.0" is the version of the server's API; web page addresses have "fuel" instead, or nothing.
    if (parts.size() > 1 && (parts[1] == "1.0" || parts[1] == "fuel")) {
        parts.erase(parts.begin() + 1);
    }
    if (parts.size() < 4 || inSmallLetters(parts[2]) != "models") return std::nullopt;
    found.owner = parts[1];
    found.model = parts[3];
    std::size_t at = 4;
    if (at < parts.size() && (isVersionNumber(parts[at]) || parts[at] == "tip")) {
        if (parts[at] != "tip") found.version = parts[at];
        ++at;
    }
    if (at < parts.size() && parts[at] == "files") ++at;
    for (; at < parts.size(); ++at) {
        if (parts[at] == "..") return std::nullopt;
        found.file += (found.file.empty() ? "" : "/") + parts[at];
    }
    return found;
}

std::optional<fs::path> findFuelModel(const ReachableFiles& files, const FuelUri& uri) {
    for (const fs::path& root : files.folders()) {
        const auto plain = folderIn(files, root, uri.model);
        if (plain && isModelFolder(files, *plain)) return plain;
        // `root` may be ~/.gz/fuel or any folder in it on the path to the model.
        std::optional<fs::path> at = root;
        for (const std::string& step : {uri.server, uri.owner, std::string("models"), uri.model}) {
            if (const auto inner = folderIn(files, *at, step)) at = inner;
        }
        if (*at == root || inSmallLetters(at->filename().string()) != inSmallLetters(uri.model)) {
            continue;
        }
        if (auto folder = versionIn(files, *at, uri.version)) return folder;
    }
    return std::nullopt;
}

}  // namespace dollytrack::gazebo
