#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dollytrack {

/// A scene in which each object is split into one draft per material: a chair's frame, seat and
/// screws are separate drafts.
struct MaterialSplit {
    std::size_t inside = 0;         // single-material drafts inside another draft's box
    std::size_t drafts = 0;         // all drafts except structure
    std::vector<bool> by_material;  // by draft: single material, no structure
};

/// Detects such a scene: nearly every draft has a material of its own, and half of the drafts are
/// inside others without just standing in them, like books in a bookcase. Returns nullopt for other
/// scenes and for more than 5000 drafts. Parts must be in the world's frame; `structure` marks the
/// drafts that are walls, floor and the like.
std::optional<MaterialSplit> findMaterialSplit(const RawScene& raw,
                                               const std::vector<bool>& structure,
                                               const std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
