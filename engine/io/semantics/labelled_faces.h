#pragma once

#include "engine/io/import/ply_mesh.h"
#include "engine/io/semantics/label_files.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::semantics {

/// One object that the files name.
struct LabelledObject {
    std::string category;  // the set's word for it; empty: none
    int nyu40 = 0;         // 0: by its category
    bool target = true;    // false: unlabelled surface, or specks of a class
};

/// Which object each face is of; indices into `objects`.
struct LabelledFaces {
    std::vector<LabelledObject> objects;
    std::vector<std::size_t> of_face;
};

/// The objects of a mesh by the numbers of its faces, else of its vertices (the number that two of
/// a face's corners share, else its first corner's), by rising number. Without numbers of objects,
/// connected pieces of one class are objects. Nothing where the mesh has no numbers.
[[nodiscard]] std::optional<LabelledFaces> labelFaces(const PlyMesh& mesh, const LabelNames& names,
                                                      bool nyu40);

}  // namespace dollytrack::semantics
