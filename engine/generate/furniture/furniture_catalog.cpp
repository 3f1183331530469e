#include "engine/generate/furniture/furniture_catalog.h"

#include <algorithm>

namespace dollytrack::generate {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDebianFolder = "/usr/share/sweethome3d/furniture";
constexpr const char* kCatalogName = "PluginFurnitureCatalog.properties";
constexpr const char* kLicenseName = "LICENSE.TXT";

}  // namespace

Result<FurnitureCatalog> FurnitureCatalog::open(const fs::path& folder) {
    const fs::path place = folder.empty() ? fs::path(kDebianFolder) : folder;
    std::vector<fs::path> paths;
    std::error_code error;
    for (fs::directory_iterator it(place, error), end; !error && it != end; it.increment(error)) {
        if (it->path().extension() == ".sh3f") paths.push_back(it->path());
    }
    std::sort(paths.begin(), paths.end());
    if (paths.empty()) {
        return fail(ErrorCode::BadInput,
                    "there is no furniture library (.sh3f) here; install Debian's package "
                    "sweethome3d-furniture, or give a folder with --library",
                    place.string());
    }
    FurnitureCatalog catalog;
    for (const fs::path& path : paths) {
        if (Status taken = catalog.take(path); !taken) return tl::unexpected(taken.error());
    }
    return catalog;
}

Status FurnitureCatalog::take(const fs::path& path) {
    auto archive = openArchive(path);
    if (!archive) return tl::unexpected(archive.error());
    const auto text = (*archive)->read(kCatalogName);
    if (!text) return tl::unexpected(text.error());
    if (!*text) {
        return fail(ErrorCode::BadInput,
                    std::string("the library contains no ") + kCatalogName + "; is it one?",
                    path.string());
    }
    CatalogText catalog = parseCatalog(std::string((*text)->begin(), (*text)->end()));
    for (CatalogPiece& piece : catalog.pieces) piece.archive = archives_.size();
    std::move(catalog.pieces.begin(), catalog.pieces.end(), std::back_inserter(pieces_));
    const auto notice = (*archive)->read(kLicenseName);
    if (notice && *notice) {
        std::string words((*notice)->begin(), (*notice)->end());
        std::erase(words, '\r');
        notices_.push_back({catalog.name, std::move(words)});
    }
    archives_.push_back(std::move(*archive));
    return {};
}

std::vector<const Archive*> FurnitureCatalog::files() const {
    std::vector<const Archive*> files;
    for (const auto& archive : archives_) files.push_back(archive.get());
    return files;
}

}  // namespace dollytrack::generate
