#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <vector>

namespace dollytrack {

/// A connected piece of a draft: surfaces that share vertices, to 0.1 mm in the world's frame.
struct DraftPiece {
    std::vector<MeshPart> meshes;  // copies of its triangles, one mesh per part
    Eigen::AlignedBox3f box;
};

/// The connected pieces of a draft in the order of their first triangles. Empty if there are fewer
/// than `least` or more than `most`.
std::vector<DraftPiece> findDraftPieces(const RawScene& raw, const ObjectDraft& draft,
                                        std::size_t least = 0,
                                        std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace dollytrack
