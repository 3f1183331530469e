#pragma once

#include "engine/io/homes/home.h"

#include <string>

namespace dollytrack::homes {

/// Writes a home without levels, groups and cameras as Home.xml: walls, rooms and pieces with
/// colours and textures. parseHomeXml() reads the same home from it, except that colours are 8-bit.
std::string homeXml(const Home& home, const std::string& name);

}  // namespace dollytrack::homes
