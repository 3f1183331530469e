#pragma once

#include "engine/generate/furniture/furniture_catalog.h"
#include "engine/generate/room_layout.h"
#include "engine/io/files/zip_writer.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack::generate {

/// The name of a library's file within a home, which may contain files of several libraries.
std::string nameInHome(std::size_t archive, const std::string& name);

/// The files of all models that a layout uses, each once: all files directly in the folder of each
/// model, with materials, textures and often a licence. Error: as of reading a damaged library.
Result<std::vector<ArchiveFile>> modelFiles(const RoomLayout& layout,
                                            const FurnitureCatalog& catalog);

}  // namespace dollytrack::generate
