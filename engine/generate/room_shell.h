#pragma once

#include "engine/core/random.h"
#include "engine/generate/room_layout.h"
#include "engine/generate/room_spec.h"
#include "engine/io/files/zip_writer.h"
#include "engine/io/homes/home.h"

#include <vector>

namespace dollytrack::generate {

/// Adds walls, floor and ceiling around a layout, with random textures (boards or tiles, plaster),
/// which are added to `files`. Error: as of writing PNG.
Status addShell(const RoomLayout& layout, RoomKind kind, Random& random, homes::Home& home,
                std::vector<ArchiveFile>& files);

}  // namespace dollytrack::generate
