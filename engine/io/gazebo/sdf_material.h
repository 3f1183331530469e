#pragma once

#include <Eigen/Core>
#include <pugixml.hpp>

#include <optional>

namespace dollytrack::gazebo {

/// The linear colour and the opacity that the <material> of a <visual> gives it: diffuse, one of
/// Gazebo's common materials by name, else ambient; nothing without.
[[nodiscard]] std::optional<Eigen::Vector4f> visualColor(const pugi::xml_node& visual);

/// 1 minus the <transparency> of a <visual>.
[[nodiscard]] float visualOpacity(const pugi::xml_node& visual);

}  // namespace dollytrack::gazebo
