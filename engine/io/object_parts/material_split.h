#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dollytrack {

/// A scene whose objects are split by material: the frame, the seat and the screws of each chair
/// are drafts.
struct MaterialSplit {
    std::size_t inside = 0;         // drafts of one material that lie inside others
    std::size_t drafts = 0;         // all but structure
    std::vector<bool> by_material;  // by draft: has one material only, and is no structure
};

/// Tells by two signs that must both be there: nearly every draft has a material of its own, and
/// half of the drafts lie inside others. None in other scenes. Parts are in the world's frame;
/// `structure` tells which drafts are walls, floor and the like.
std::optional<MaterialSplit> findMaterialSplit(const RawScene& raw,
                                               const std::vector<bool>& structure,
                                               const std::vector<ObjectDraft>& drafts);

/// Whether half of the smaller box or more is inside the larger one.
bool liesInside(const Eigen::AlignedBox3f& smaller, const Eigen::AlignedBox3f& larger);

}  // namespace dollytrack
