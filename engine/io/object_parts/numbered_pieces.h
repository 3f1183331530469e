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

/// Joins the pieces of furniture in Cinema 4D's OBJ files, whose groups are named by their paths in
/// the object tree, with blanks between the names: "office chair_Instanz_11 W_rfel_2". Pieces of
/// one path that lie together are joined, if its last name is that of furniture. Returns the number
/// of drafts that were joined to others; 0 for other scenes.
std::size_t joinPiecesOfPaths(const RawScene& raw, const LabelTable& labels,
                              std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
