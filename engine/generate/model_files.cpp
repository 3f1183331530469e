#include "engine/generate/model_files.h"

#include <set>

namespace dollytrack::generate {
namespace {

std::string folderOf(const std::string& name) {
    const auto slash = name.rfind('/');
    return slash == std::string::npos ? "" : name.substr(0, slash);
}

}  // namespace

std::string nameInHome(std::size_t archive, const std::string& name) {
    return std::to_string(archive) + "/" + name;
}

Result<std::vector<ArchiveFile>> modelFiles(const RoomLayout& layout,
                                            const FurnitureCatalog& catalog) {
    const std::vector<const Archive*> archives = catalog.files();
    std::vector<std::set<std::string>> folders(archives.size());
    for (const PlacedPiece& placed : layout.pieces()) {
        folders[placed.piece->archive].insert(folderOf(placed.piece->model));
    }
    std::vector<ArchiveFile> files;
    for (std::size_t i = 0; i < archives.size(); ++i) {
        std::set<std::string> names;  // of duplicate names in an archive the first counts
        for (const std::string& name : archives[i]->names()) {
            if (folders[i].contains(folderOf(name))) names.insert(name);
        }
        for (const std::string& name : names) {
            auto bytes = archives[i]->read(name);
            if (!bytes) return tl::unexpected(bytes.error());
            if (*bytes) files.push_back({nameInHome(i, name), std::move(**bytes)});
        }
    }
    return files;
}

}  // namespace dollytrack::generate
