#pragma once

#include "engine/scene/scene.h"

#include <optional>
#include <vector>

namespace dollytrack {

/// Rotates a vector about the vertical axis. An angle of 0 leaves every bit unchanged.
Eigen::Vector3d turnLevel(const Eigen::Vector3d& vector, double turn_rad);

/// Moves an object as a rigid body: a turn about the vertical axis through the centre of its box,
/// then a translation. Its vertices, normals, box, centroid and front move with it. All other
/// objects stay, also those that stand on it, and so do the room bounds.
void moveObject(Scene& scene, int object_id, const Eigen::Vector3d& offset_m, double turn_rad);

/// The axis-aligned box around an object's vertices.
Eigen::AlignedBox3d cornerBox(const Scene& scene, int object_id);

/// The objects whose vertices have moved, by rising id. Empty unless both scenes have the same
/// triangles in the same objects, the same frame and the same room bounds.
std::optional<std::vector<int>> movedObjects(const Scene& before, const Scene& after);

}  // namespace dollytrack
