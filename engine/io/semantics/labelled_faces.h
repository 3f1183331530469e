#pragma once

#include "engine/io/models/ply_mesh.h"
#include "engine/io/semantics/label_files.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::semantics {

/// An object of a labelled mesh.
struct LabelledObject {
    std::string category;      // class name in the dataset; empty: none
    int nyu40 = 0;             // 0: determined by `category`
    bool target = true;        // false: unlabelled surface, or small pieces of a class
    std::int64_t number = -1;  // of the object in the file; -1: none
};

/// The objects of a mesh and the object of each face.
struct LabelledFaces {
    std::vector<LabelledObject> objects;
    std::vector<std::size_t> of_face;  // index into `objects`
    bool classes_are_nyu40 = false;
};

/// The objects of a mesh, in increasing order of their numbers. A face has its own number, or the
/// one that two of its corners share (otherwise its first corner's). Without object numbers, each
/// connected piece of one class is an object. Returns nullopt if the mesh has no numbers.
[[nodiscard]] std::optional<LabelledFaces> labelFaces(const PlyMesh& mesh, const LabelNames& names);

}  // namespace dollytrack::semantics
