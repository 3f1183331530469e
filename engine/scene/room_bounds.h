#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// The world-aligned box around an object.
Eigen::AlignedBox3d worldBounds(const OrientedBox& box);

/// Whether an object is a sky or a backdrop by its class and name; see namesBackdrop().
bool isBackdrop(const Object& object);

/// The bounds of the building: the box around the largest group of objects that are near each
/// other. Skies, backdrops, wide ground planes and distant objects are excluded.
Eigen::AlignedBox3d findRoomBounds(const std::vector<Object>& objects);

/// The same for a scene with meshes, where other groups of objects count, too, if their meshes
/// enclose a room with objects in it, wherever it stands. The names of all objects that are
/// excluded are added to `left_out`.
Eigen::AlignedBox3d findRoomBounds(const Scene& scene, std::vector<std::string>& left_out);

}  // namespace dollytrack
