#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/annotation_file.h"
#include "engine/scene/label_table.h"

#include <string>
#include <vector>

namespace dollytrack {

/// The objects of an annotation file, and the parts of the scene that they use.
struct AnnotatedDrafts {
    std::vector<ObjectDraft> drafts;    // in the order of the annotations
    std::vector<bool> taken;            // by part: whether it belongs to one of them
    std::vector<std::string> warnings;  // names that do not occur in the scene, and the like
};

/// Finds the parts of each object: those of the named nodes and all nodes below them, of the named
/// meshes, and the ranges of triangles, which are cut out of their mesh as new parts. A part or
/// triangle that several objects name belongs to the first.
AnnotatedDrafts takeAnnotated(const std::vector<AnnotatedObject>& objects, const LabelTable& labels,
                              RawScene& raw);

}  // namespace dollytrack
