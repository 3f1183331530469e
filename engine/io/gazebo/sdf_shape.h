#pragma once

#include "engine/core/result.h"
#include "engine/io/gazebo/sdf_frames.h"
#include "engine/io/gazebo/visuals.h"

#include <pugixml.hpp>

#include <string>

namespace dollytrack::gazebo {

/// Reads the mesh or shape in a visual's <geometry>; false if it has none that is supported. `link`
/// names the visual's link in errors. Error: BadInput.
[[nodiscard]] Result<bool> readShape(const pugi::xml_node& geometry, const std::string& link,
                                     const Scope& scope, Visual& visual);

}  // namespace dollytrack::gazebo
