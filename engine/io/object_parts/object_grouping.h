#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/scene/label_table.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// What will become one object: its name, what the name says, and the parts it is made of.
struct ObjectDraft {
    std::string name;
    Label label;
    std::vector<std::size_t> parts;  // indices into RawScene::parts
    bool loose = false;              // a piece of a scene taken apart: its name is a material's
    std::optional<Eigen::Vector3d> front;  // as the source gives it, in the source's axes
};

/// One draft for each object that the source itself names; a draft's class is the source's, else
/// the one of its category, else of its name.
std::vector<ObjectDraft> draftsOfSource(const RawScene& raw, const LabelTable& labels);

/// One draft for each node that holds meshes, in the file's order. The pieces that one thing was
/// cut into come together: nodes named after the node above them, and unnamed nodes under a node
/// whose name is a thing to look at. Parts that are `taken` already are left out.
std::vector<ObjectDraft> groupByNodes(const RawScene& raw, const LabelTable& labels,
                                      const std::vector<bool>& taken = {});

/// The box around a draft's parts.
Eigen::AlignedBox3f boundsOf(const RawScene& raw, const ObjectDraft& draft);

/// "mat12", "Material.003", "default": a material's name that tells nothing.
bool isMaterialNumber(const std::string& name);

}  // namespace dollytrack
