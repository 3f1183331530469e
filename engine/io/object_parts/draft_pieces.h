#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <vector>

namespace dollytrack {

/// One connected piece of a draft: surfaces that share corners, to 0.1 mm in the world's frame.
struct DraftPiece {
    std::vector<MeshPart> meshes;  // copies, one for each part that the piece has triangles of
    Eigen::AlignedBox3f box;
};

/// In the order of their first triangles, so that the result depends on nothing else. None, where
/// there are less than `least` or more than `most`.
std::vector<DraftPiece> findDraftPieces(const RawScene& raw, const ObjectDraft& draft,
                                        std::size_t least = 0,
                                        std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace dollytrack
