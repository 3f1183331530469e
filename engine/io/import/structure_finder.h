#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <vector>

namespace dollytrack {

/// Returns for each draft whether it is structure: by its name or, if that is not specific, by
/// shape and position (wall, floor, ceiling, ground, sky or building shell). Sets the labels of
/// drafts found by shape. Parts must be in the world's frame.
std::vector<bool> findStructure(const RawScene& raw, std::vector<ObjectDraft>& drafts);

/// Finds structure by shape among the targets whose names say nothing, for the objects of a source
/// without classes. Does nothing if the scene is smaller than a room or has few objects,
/// because a robot's base plate is no floor, or if no target would remain.
void findUnnamedStructure(const RawScene& raw, std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
