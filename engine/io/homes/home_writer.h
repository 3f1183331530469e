#pragma once

#include "engine/io/homes/home.h"

#include <string>

namespace dollytrack::homes {

/// Writes a home as Home.xml: walls, rooms and pieces with colours (8 bits per channel) and
/// textures. Not written: levels, groups, cameras, wall tops, baseboards, staircase holes, and the
/// pitch, roll, centring and material colours of pieces.
std::string homeXml(const Home& home, const std::string& name);

}  // namespace dollytrack::homes
