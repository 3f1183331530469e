#pragma once

#include <Eigen/Core>
#include <pugixml.hpp>

#include <optional>
#include <string>

namespace dollytrack::gazebo {

/// Linear colour and opacity of a <visual> by its <material>: diffuse, otherwise one of Gazebo's
/// common materials by name, otherwise ambient; nullopt without these.
[[nodiscard]] std::optional<Eigen::Vector4f> visualColor(const pugi::xml_node& visual);

/// The name of a <visual>'s material script that is not one of Gazebo's common materials, so that
/// its colours and textures are not read; empty: none.
[[nodiscard]] std::string unreadScript(const pugi::xml_node& visual);

/// 1 minus the <transparency> of a <visual>.
[[nodiscard]] float visualOpacity(const pugi::xml_node& visual);

}  // namespace dollytrack::gazebo
