#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// Leaves out objects that lie absurdly far from all others, such as those that fell through the
/// floor of a physics simulation: by more than 500 m and more than 20 times the size of the rest.
/// Empties their parts, removes them from the lists of drafts and adds one warning. Does nothing if
/// a third of the objects or more would be left out. Returns whether objects were left out.
bool dropFarObjects(RawScene& raw, double unit_m, std::vector<ObjectDraft>& annotated,
                    std::vector<ObjectDraft>& drafts, ImportReport& report);

}  // namespace dollytrack
