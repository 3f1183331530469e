#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// The world-aligned box around an object.
Eigen::AlignedBox3d worldBounds(const OrientedBox& box);

/// The building: the box around the largest group of objects that are near each other, without
/// skies, wide grounds and things far away. What was left out is said in `left_out`.
Eigen::AlignedBox3d findRoomBounds(const std::vector<Object>& objects,
                                   std::vector<std::string>* left_out = nullptr);

}  // namespace dollytrack
