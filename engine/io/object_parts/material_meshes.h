#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// Result of regroupMaterialMeshes().
struct MaterialMeshes {
    std::vector<std::string> names;     // drafts with parts of several objects
    std::vector<std::string> doubtful;  // drafts that may contain several objects; not changed
    std::size_t objects = 0;            // number of objects made of the drafts in `names`
    std::size_t unnamed = 0;            // number of these without a class
};

/// Finds drafts that contain parts of several objects, which exporters make if they split a scene
/// by material ("ChairMetal" with the frames of all chairs), and regroups their connected pieces
/// into objects. Pieces belong to one object if they touch or are within 3 cm and their names do
/// not indicate different classes. A draft is regrouped only if this is certain: if it is larger
/// than its class can be and the resulting objects are not, if the same arrangement of pieces of
/// several drafts occurs at least three times, or if the draft is spread over a room, or without a
/// class over most of the scene. Parts must be
/// in the world's frame. If `apply` is false, nothing is changed.
MaterialMeshes regroupMaterialMeshes(RawScene& raw, const LabelTable& labels,
                                     std::vector<ObjectDraft>& drafts, bool apply);

}  // namespace dollytrack
