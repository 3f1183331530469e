#pragma once

#include "engine/core/result.h"
#include "engine/io/object_parts/material_meshes.h"
#include "engine/io/object_parts/material_split.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/object_parts/piece_merge.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/scene/scene.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

// Functions that add notes and warnings about the import to its report.

void noteRepairs(const RepairCounts& repairs, ImportReport& report);

/// Lists the named pieces that were merged into other objects.
void noteMerges(const std::vector<MergedPiece>& merges, const std::vector<ObjectDraft>& drafts,
                ImportReport& report);

/// Lists meshes that contain parts of several objects, and whether they were regrouped.
void noteMaterialMeshes(const MaterialMeshes& found, bool regrouped, ImportReport& report);

/// Warns that objects are split by material. `objects`: how many remain after regrouping; empty if
/// they were not regrouped.
void noteMaterialSplit(const MaterialSplit& found, std::optional<std::size_t> objects,
                       ImportReport& report);

/// `proxies` are the names of collision meshes and the like, `twice` is the number of duplicate
/// meshes.
void noteUnseen(const std::vector<std::string>& proxies, std::size_t twice, ImportReport& report);

/// `objects`: how many have faces that separateSides() moved apart.
void noteSeparatedSides(std::size_t objects, ImportReport& report);

/// Warns if the scene is so far from the origin (about 8 km) that its single-precision coordinates
/// have a resolution of more than a millimetre.
void noteFarAway(const RawScene& raw, double unit_m, ImportReport& report);

/// The error for a file without any drawable triangle, with the reason.
[[nodiscard]] Error nothingToDraw(const RawScene& raw, const std::filesystem::path& path);

}  // namespace dollytrack
