#pragma once

#include "engine/core/result.h"
#include "engine/io/gazebo/visuals.h"

#include <Eigen/Geometry>
#include <pugixml.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gazebo {

/// Reads an XML file of at most 64 MiB. Error: BadInput, with the place.
[[nodiscard]] Result<pugi::xml_document> readXml(const std::filesystem::path& path);

/// The finite numbers of a text, separated by blanks; nothing where something else is in it.
[[nodiscard]] std::optional<std::vector<double>> numbersOf(std::string_view text);

/// As many numbers as asked for; nothing where there are others.
[[nodiscard]] std::optional<Eigen::Vector3d> vectorOf(std::string_view text);

/// A turn about the fixed axes x, y and z, in this order; radians.
[[nodiscard]] Eigen::Quaterniond turnOf(const Eigen::Vector3d& roll_pitch_yaw);

/// A colour of three or four sRGB numbers of 0 to 1 as a linear one; nothing where it is none.
[[nodiscard]] std::optional<Eigen::Vector4f> colorOf(std::string_view text);

/// Whether an XML text is full of xacro's macros, which have to be expanded first.
[[nodiscard]] bool holdsXacro(std::string_view text);

}  // namespace dollytrack::gazebo
