#pragma once

#include "engine/generate/room_layout.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dollytrack::generate {

/// "Chair 3": a name for each piece that tells its class and is there once.
std::vector<std::string> namesOf(const RoomLayout& layout);

/// What is true of each piece, doors and windows among them, in the world's frame (metres, z up,
/// the room from (0, -width) to (length, 0)): name, class, the middle of its box, its size along
/// its own axes (across, front to back, up), the turn of the first of them about z, where its front
/// looks, and what it stands on, lies in or hangs at.
nlohmann::ordered_json truthOf(const RoomLayout& layout, const std::vector<std::string>& names);

/// Each model used, its author and its licence, then what the libraries say of themselves.
std::string licensesOf(const RoomLayout& layout, const FurnitureCatalog& catalog);

}  // namespace dollytrack::generate
