#pragma once

#include "engine/io/object_parts/object_grouping.h"

#include <cstddef>
#include <vector>

namespace dollytrack {

/// Joins the pieces of furniture in exports of Sweet Home 3D (OBJ, or converted from it). There,
/// each shape of each piece of furniture is a mesh of its own, and the meshes of all furniture are
/// numbered consecutively: "Pied_58", "Pied_2_59", "Assise_62". Pieces that are attached to each
/// other are joined, and those numbered between them that lie within. Walls, rooms and the ground,
/// which have numbers too, stay as they are; all other drafts are labelled as targets afterwards.
/// Parts must be in the world's frame. Returns the number of drafts that were joined to others; 0
/// for other scenes.
std::size_t joinNumberedPieces(const RawScene& raw, std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
