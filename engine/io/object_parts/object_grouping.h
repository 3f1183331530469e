#pragma once

#include "engine/io/raw_scene/raw_scene.h"
#include "engine/scene/label_table.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// A future object: its name, its label and its parts.
struct ObjectDraft {
    std::string name;
    Label label;                           // what the name means
    std::vector<std::size_t> parts;        // indices into RawScene::parts
    bool loose = false;                    // a piece of a split mesh, named after its material
    std::optional<Eigen::Vector3d> front;  // from the source, in the source's axes
};

/// One draft for each object that the source itself defines. Its class is that of the source,
/// otherwise of its category, otherwise of its name.
std::vector<ObjectDraft> draftsOfSource(const RawScene& raw, const LabelTable& labels);

/// One draft for each node with meshes, in the file's order. Nodes named after their parent node,
/// and unnamed nodes below a node with the name of a target, are joined to it. Parts marked in
/// `taken` are left out.
std::vector<ObjectDraft> groupByNodes(const RawScene& raw, const LabelTable& labels,
                                      const std::vector<bool>& taken = {});

/// The bounding box of a draft's parts.
Eigen::AlignedBox3f boundsOf(const RawScene& raw, const ObjectDraft& draft);

/// Whether a name is a generic material name: "mat12", "Material.003", "default".
bool isMaterialNumber(const std::string& name);

}  // namespace dollytrack
