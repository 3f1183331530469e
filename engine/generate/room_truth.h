#pragma once

#include "engine/generate/room_layout.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dollytrack::generate {

/// A unique name for each piece: its library name with a number, such as "Chair 3".
std::vector<std::string> namesOf(const RoomLayout& layout);

/// Ground truth of all pieces, including doors and windows, in the world's frame (metres, z up, the
/// room from (0, -width) to (length, 0)): name, class, centre of the box, size along the piece's
/// own axes (width, depth, height), rotation about z, direction of the front, and supporter.
nlohmann::ordered_json truthOf(const RoomLayout& layout, const std::vector<std::string>& names);

/// The models used with their authors and licences, then the licence texts of their libraries.
std::string licensesOf(const RoomLayout& layout, const FurnitureCatalog& catalog);

}  // namespace dollytrack::generate
