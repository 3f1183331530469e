#pragma once

#include "engine/core/result.h"
#include "engine/generate/furniture/catalog_text.h"
#include "engine/io/files/file_source.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::generate {

/// The LICENSE.TXT of a library.
struct LibraryNotice {
    std::string library;
    std::string text;
};

/// Furniture libraries of Sweet Home 3D (.sh3f: a zip of OBJ models with
/// PluginFurnitureCatalog.properties).
class FurnitureCatalog {
  public:
    /// Opens every .sh3f file in a folder, in order of name. An empty path means the folder of
    /// Debian's package sweethome3d-furniture. Error: BadInput if there is none or one is damaged.
    static Result<FurnitureCatalog> open(const std::filesystem::path& folder);

    [[nodiscard]] const std::vector<CatalogPiece>& pieces() const { return pieces_; }
    [[nodiscard]] const std::vector<LibraryNotice>& notices() const { return notices_; }
    [[nodiscard]] std::vector<const Archive*> files() const;

  private:
    Status take(const std::filesystem::path& path);

    std::vector<std::unique_ptr<Archive>> archives_;
    std::vector<CatalogPiece> pieces_;
    std::vector<LibraryNotice> notices_;
};

}  // namespace dollytrack::generate
