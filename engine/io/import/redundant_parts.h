#pragma once

#include "engine/io/raw_scene/raw_scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// Removes a part's mesh, and keeps its name and node.
void emptyPart(MeshPart& part);

/// Empties collision meshes: parts named UCX_, UBX_, USP_ or UCP_ (Unreal's convention),
/// ..._collision, ..._collider or ..._colonly, or below a node "Colliders"; also ..._col, ..._hull
/// and ..._physics if they coincide with another part. Returns their names. Does nothing if no
/// other part would remain.
std::vector<std::string> dropProxies(RawScene& raw);

/// Empties parts with the same vertices and triangles as an earlier part. Returns their number.
std::size_t dropDuplicates(RawScene& raw);

}  // namespace dollytrack
