#pragma once

#include "engine/core/random.h"
#include "engine/generate/room_layout.h"
#include "engine/generate/room_spec.h"
#include "engine/io/files/zip_writer.h"
#include "engine/io/homes/home.h"

#include <vector>

namespace dollytrack::generate {

/// Walls, floor and ceiling around a layout, painted by chance: boards or tiles, plaster. The
/// pictures that they need are added to `files`.
Status addShell(const RoomLayout& layout, RoomKind kind, Random& random, homes::Home& home,
                std::vector<ArchiveFile>& files);

}  // namespace dollytrack::generate
