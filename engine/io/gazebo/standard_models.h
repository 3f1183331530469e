#pragma once

#include <string>
#include <string_view>

namespace dollytrack::gazebo {

/// The SDF text of a model that comes with Gazebo, so that worlds include it without its files:
/// `sun`, which is a light, or `ground_plane`, which is 100 m wide. `uri` is model://NAME or the
/// model's address on Gazebo Fuel. Returns an empty text for all other models.
[[nodiscard]] std::string_view standardModel(const std::string& uri);

}  // namespace dollytrack::gazebo
