#pragma once

#include "engine/scene/scene.h"

#include <optional>
#include <vector>

namespace dollytrack {

/// A direction or offset, turned about the vertical. By no angle it keeps every bit.
Eigen::Vector3d turnLevel(const Eigen::Vector3d& vector, double turn_rad);

/// Puts an object elsewhere as a rigid body: turned about the vertical through the middle of its
/// box, then moved. All that is measured of it goes along: corners, normals, box, centroid, front.
/// Other objects stay, those that stand on it, too, and so do the bounds of the rooms.
void moveObject(Scene& scene, int object_id, const Eigen::Vector3d& offset_m, double turn_rad);

/// Around the corners of an object.
Eigen::AlignedBox3d cornerBox(const Scene& scene, int object_id);

/// The objects whose corners are not where they were, by rising id. Nothing when the scenes are
/// not of the same triangles in the same objects, in one frame and in rooms of the same bounds.
std::optional<std::vector<int>> movedObjects(const Scene& before, const Scene& after);

}  // namespace dollytrack
