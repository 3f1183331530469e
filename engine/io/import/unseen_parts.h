#pragma once

#include "engine/io/import/raw_scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// Empties the parts that are there for physics, not to be seen: named UCX_, UBX_, USP_ or UCP_
/// (Unreal's habit), ..._collision, ..._collider, ..._colonly, or below a node "Colliders"; and
/// ..._col, ..._hull or ..._physics where they lie about another part. Returns their names; nothing
/// is emptied where nothing would remain.
std::vector<std::string> dropProxies(RawScene& raw);

/// Empties parts that are the same as an earlier one, corner for corner, in the same place.
/// Returns how many.
std::size_t dropDuplicates(RawScene& raw);

}  // namespace dollytrack
