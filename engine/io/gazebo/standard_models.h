#pragma once

#include <string>
#include <string_view>

namespace dollytrack::gazebo {

/// SDF of a model that comes with Gazebo and that worlds include without shipping it: `sun`, a
/// light, and `ground_plane`, a plane 100 m wide. By model:// or by the address on Fuel. Empty for
/// all other models.
[[nodiscard]] std::string_view standardModel(const std::string& uri);

}  // namespace dollytrack::gazebo
