#pragma once

#include "engine/generate/furniture_catalog.h"
#include "engine/generate/room_layout.h"
#include "engine/io/files/zip_writer.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack::generate {

/// What a library's file is called in a home, where those of several libraries lie side by side.
std::string nameInHome(std::size_t archive, const std::string& name);

/// The files of every model that a layout uses, each once: all that lies in the model's folder of
/// its library, which holds its materials, pictures and often a licence.
Result<std::vector<ArchiveFile>> modelFiles(const RoomLayout& layout,
                                            const FurnitureCatalog& catalog);

}  // namespace dollytrack::generate
