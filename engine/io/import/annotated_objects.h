#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/settings/annotation_file.h"
#include "engine/scene/label_table.h"

#include <string>
#include <vector>

namespace dollytrack {

/// Objects as a person names them, and what of the scene they leave to be guessed.
struct AnnotatedDrafts {
    std::vector<ObjectDraft> drafts;    // in the order of the annotations
    std::vector<bool> taken;            // by part: it belongs to one of them
    std::vector<std::string> warnings;  // names that nothing in the scene has
};

/// Finds the parts of each object: those of nodes with these names and of all below them, meshes
/// with these names, and ranges of triangles, which are cut out of their mesh as parts of their
/// own. What two objects ask for belongs to the first.
AnnotatedDrafts takeAnnotated(const std::vector<io::AnnotatedObject>& objects,
                              const LabelTable& labels, RawScene& raw);

}  // namespace dollytrack
