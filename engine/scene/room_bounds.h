#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// The world-aligned box around an object.
Eigen::AlignedBox3d worldBounds(const OrientedBox& box);

/// The bounds of the building: the box around the largest group of objects that are near each
/// other. Skies, wide ground planes and distant objects are excluded; their names are added to
/// `left_out`.
Eigen::AlignedBox3d findRoomBounds(const std::vector<Object>& objects,
                                   std::vector<std::string>* left_out = nullptr);

}  // namespace dollytrack
