#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"

#include <vector>

namespace dollytrack {

/// Tells for each draft whether it is structure: because its name says so, or, where the name says
/// nothing, because it has the shape and place of a wall, floor, ceiling, ground, sky or shell.
/// Labels of drafts found by shape are set. Parts are in the world's frame.
std::vector<bool> findStructure(const RawScene& raw, std::vector<ObjectDraft>& drafts);

}  // namespace dollytrack
