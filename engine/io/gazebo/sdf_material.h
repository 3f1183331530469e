#pragma once

#include <Eigen/Core>
#include <pugixml.hpp>

#include <optional>
#include <string>

namespace dollytrack::gazebo {

/// Linear colour and opacity of a <visual> by its <material>: diffuse, otherwise one of Gazebo's
/// common materials by name, otherwise ambient; nullopt without these.
[[nodiscard]] std::optional<Eigen::Vector4f> visualColor(const pugi::xml_node& visual);

/// The name of the material in a <visual>'s <script>; empty if it has none, or one of Gazebo's
/// common materials, whose colours are known.
[[nodiscard]] std::string scriptName(const pugi::xml_node& visual);

/// 1 minus the <transparency> of a <visual>.
[[nodiscard]] float visualOpacity(const pugi::xml_node& visual);

}  // namespace dollytrack::gazebo
