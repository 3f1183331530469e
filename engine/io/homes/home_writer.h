#pragma once

#include "engine/io/homes/home.h"

#include <string>

namespace dollytrack::homes {

/// A home without levels, groups and cameras as Home.xml: walls, rooms, pieces, their colours and
/// pictures. What parseHomeXml() makes of it is the same home, but for colours, which are 8-bit.
std::string homeXml(const Home& home, const std::string& name);

}  // namespace dollytrack::homes
