#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// What was found of meshes that hold parts of several objects.
struct MaterialMeshes {
    std::vector<std::string> names;     // of the drafts that were, or should be, taken apart
    std::vector<std::string> doubtful;  // of drafts that may hold several, and are left whole
    std::size_t objects = 0;            // that their pieces make
    std::size_t unnamed = 0;            // of these, objects whose class nothing tells
};

/// Finds drafts that hold parts of objects in many places, as exporters make of scenes that are
/// split by material ("ChairMetal" with the frames of all chairs), and puts their pieces together
/// to objects instead: connected pieces that touch, or float beside each other, and whose names do
/// not say that they are of different classes. A draft is taken apart only where that is sure:
/// where it is larger than its class can be and its objects are not, where the same arrangement of
/// pieces of several drafts is there three times or more, or where it is spread over a room.
/// Parts are in the world's frame. With `apply` off nothing is changed.
MaterialMeshes regroupMaterialMeshes(RawScene& raw, const LabelTable& labels,
                                     std::vector<ObjectDraft>& drafts, bool apply);

}  // namespace dollytrack
