#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"

namespace dollytrack {

/// Removes the names of drafts that fill the whole scene and contain the centres of more than five
/// other objects: a mesh that was joined from all objects has the name of one of them. Parts must
/// be in the world's frame.
void dropNamesOfJoinedScenes(const RawScene& raw, std::vector<ObjectDraft>& drafts);

/// Splits drafts that contain a whole room into connected pieces (surfaces that share vertices, to
/// 0.1 mm): if one node is nearly the whole scene, or if an unnamed node spans a room with hardly
/// any other object. Each piece becomes a draft, named after its material. Parts must be in the
/// world's frame. Returns the number of split drafts.
std::size_t splitMergedScenes(RawScene& raw, const LabelTable& labels,
                              std::vector<ObjectDraft>& drafts);

/// Splits drafts that contain several distant objects (all spot lights of a room in one node):
/// clusters more than half a metre apart become drafts with the same name and a number. Returns
/// the number of split drafts.
std::size_t splitScattered(RawScene& raw, const LabelTable& labels,
                           std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
