#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/scene/scene.h"

#include <vector>

namespace dollytrack {

/// Copies the drafts' parts into the scene as objects with box and centroid, and frees the parts'
/// memory. The parts must be in the world's frame, and Scene::source_from_world must be set.
void assembleObjects(std::vector<MeshPart>& parts, const std::vector<ObjectDraft>& drafts,
                     Scene& scene);

/// Transforms every part from the source's frame to the world's.
void moveToWorld(std::vector<MeshPart>& parts, const Eigen::Affine3d& world_from_source);

}  // namespace dollytrack
