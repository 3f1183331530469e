#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/material_meshes.h"
#include "engine/io/object_parts/material_split.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/object_parts/piece_merge.h"
#include "engine/scene/scene.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

// What the import did and what is doubtful, as sentences of the report.

/// "1 face was dropped", "2 faces were dropped".
[[nodiscard]] std::string counted(std::size_t count, const char* one, const char* many);

void noteRepairs(const RepairCounts& repairs, ImportReport& report);

/// What the file names and is no object any more is told by its name, with what it went into.
void noteMerges(const std::vector<MergedPiece>& merges, const std::vector<ObjectDraft>& drafts,
                ImportReport& report);

/// Says which meshes hold parts of several objects, and what came of it or is to be done.
void noteMaterialMeshes(const MaterialMeshes& found, bool regrouped, ImportReport& report);

/// Warns that objects are split by material. `objects`: how many remain after regrouping; empty if
/// they were not regrouped.
void noteMaterialSplit(const MaterialSplit& found, std::optional<std::size_t> objects,
                       ImportReport& report);

/// `proxies` are names of meshes for physics, `twice` counts meshes that are there again.
void noteUnseen(const std::vector<std::string>& proxies, std::size_t twice, ImportReport& report);

/// Corners are kept as numbers of 24 bits, as nearly every format keeps them: warns where they are
/// more than a millimetre apart, at 8 km.
void noteFarAway(const RawScene& raw, double unit_m, ImportReport& report);

/// Why nothing of the file can be drawn.
[[nodiscard]] Error nothingToDraw(const RawScene& raw, const std::filesystem::path& path);

}  // namespace dollytrack
