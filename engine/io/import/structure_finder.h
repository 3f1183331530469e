#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <vector>

namespace dollytrack {

/// Returns for each draft whether it is structure: by its name or, if that is not specific, by
/// shape and position (wall, floor, ceiling, ground, sky or building shell). Sets the labels of
/// drafts found by shape. Parts must be in the world's frame.
std::vector<bool> findStructure(const RawScene& raw, std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
