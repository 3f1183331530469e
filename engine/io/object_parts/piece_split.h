#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"

namespace dollytrack {

/// Takes drafts that hold a whole room apart into connected pieces (surfaces that share corners,
/// to 0.1 mm): where one node is nearly all there is, or where an unnamed one spans a room that
/// has hardly any other object. Each piece becomes a draft of its own, named after its material.
/// Parts are in the world's frame. Returns how many drafts were taken apart.
std::size_t splitMergedScenes(RawScene& raw, const LabelTable& labels,
                              std::vector<ObjectDraft>& drafts);

/// Takes drafts apart that hold several things far from each other (all spot lights of a room in
/// one node): clusters with more than half a metre between them become drafts of their own, named
/// alike with a number. Returns how many drafts were taken apart.
std::size_t splitScattered(RawScene& raw, const LabelTable& labels,
                           std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
