#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dollytrack {

/// A scene in which each object is split into one draft per material: a chair's frame, seat and
/// screws are separate drafts.
struct MaterialSplit {
    std::size_t inside = 0;         // drafts of one material that lie inside another one's box
    std::size_t drafts = 0;         // compared: all but structure
    std::vector<bool> by_material;  // for each draft: one material, no structure
};

/// Detects such a scene: nearly every draft has a material of its own, and half of the drafts lie
/// inside others, without just standing in them as books stand in a bookcase. Nothing for other
/// scenes, nor for more than 5000 drafts. Parts are in the world's frame; `structure` tells which
/// drafts are walls, floor and the like.
std::optional<MaterialSplit> findMaterialSplit(const RawScene& raw,
                                               const std::vector<bool>& structure,
                                               const std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
