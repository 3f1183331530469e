#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack {

/// Removes a part's mesh, and keeps its name and node.
void emptyPart(MeshPart& part);

/// Empties meshes that are not meant to be seen, and returns their names:
/// - collision meshes: UCX_..., UBX_..., USP_..., UCP_... (Unreal's convention), ..._collision,
///   ..._collider, ..._colonly, hitbox..., and all below a node "Colliders"
/// - CTRL_Hole..., the boxes with which Archimesh cuts holes into walls
/// - ..._col, ..._hull, ..._physics and ...trigger, if they coincide with another part
/// Does nothing if no other part would remain.
std::vector<std::string> dropProxies(RawScene& raw);

/// Empties parts with the same vertices and triangles as an earlier part. Returns their number.
std::size_t dropDuplicates(RawScene& raw);

/// Moves faces of one draft that coincide, face in opposite directions and have different materials
/// 0.5 mm apart, each to the side that it faces, because otherwise it is undefined which of them is
/// seen. SketchUp exports a face with two materials as such a pair. Positions are in metres.
/// Returns the number of drafts with such faces.
std::size_t separateSides(const std::vector<ObjectDraft>& drafts, std::vector<MeshPart>& parts);

}  // namespace dollytrack
