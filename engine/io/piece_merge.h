#pragma once

#include "engine/io/object_grouping.h"
#include "engine/io/raw_scene.h"

namespace dollytrack {

/// Puts pieces together that one thing was modelled from: pieces whose name says nothing of their
/// own ("Circle.012", "Wood_Mesh031", "handle", pieces of a scene taken apart) with what they are
/// attached to, and the boards of one shelf. What merely stands on something stays apart: a cup
/// on a table, a table on the floor. Parts are in the world's frame.
/// `structure` tells which drafts are walls, floor and the like; only pieces named as parts join
/// those (a handle its door). Returns how many drafts went into others.
std::size_t mergePieces(const RawScene& raw, const std::vector<bool>& structure,
                        std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
