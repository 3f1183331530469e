#include "engine/generate/model_files.h"

#include <map>
#include <set>

namespace dollytrack::generate {
namespace {

std::string folderOf(const std::string& name) {
    const auto slash = name.rfind('/');
    return slash == std::string::npos ? "" : name.substr(0, slash);
}

}  // namespace

Result<std::vector<ArchiveFile>> modelFiles(const RoomLayout& layout,
                                            const FurnitureCatalog& catalog) {
    std::set<std::string> folders;
    for (const PlacedPiece& placed : layout.pieces()) folders.insert(folderOf(placed.piece->model));
    std::map<std::string, std::vector<std::uint8_t>> files;  // by name, so that their order is one
    for (const Archive* source : catalog.files()) {
        for (const std::string& name : source->names()) {
            if (!folders.contains(folderOf(name)) || files.contains(name)) continue;
            auto bytes = source->read(name);
            if (!bytes) return tl::unexpected(bytes.error());
            if (*bytes) files.emplace(name, std::move(**bytes));
        }
    }
    std::vector<ArchiveFile> list;
    for (auto& [name, bytes] : files) list.push_back({name, std::move(bytes)});
    return list;
}

}  // namespace dollytrack::generate
