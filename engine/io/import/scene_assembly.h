#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// Lays the drafts' parts out as objects, one after the other, with box and centroid. The parts
/// must be in the world's frame, and Scene::source_from_world set; their memory is freed on the
/// way.
void assembleObjects(std::vector<MeshPart>& parts, const std::vector<ObjectDraft>& drafts,
                     Scene& scene);

/// Moves every part from the source's frame into the world's.
void moveToWorld(std::vector<MeshPart>& parts, const Eigen::Affine3d& world_from_source);

}  // namespace dollytrack
