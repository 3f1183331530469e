#pragma once

#include "engine/io/gazebo/sdf_frames.h"

#include <pugixml.hpp>
#include <tl/expected.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack::gazebo {

/// A world's <population>: equal models in a grid or a row.
struct Population {
    pugi::xml_node model;             // <model> or <include>
    std::vector<Frame::Copy> copies;  // named NAME_clone_0 and so on
};

/// Places the models of a <population> as Gazebo Classic does. Error: why they cannot be placed,
/// such as a random distribution, for "... is left out, since ...".
[[nodiscard]] tl::expected<Population, std::string> readPopulation(const pugi::xml_node& element,
                                                                   std::size_t most_models);

}  // namespace dollytrack::gazebo
