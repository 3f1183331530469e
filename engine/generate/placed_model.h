#pragma once

#include "engine/generate/room_layout.h"
#include "engine/io/homes/home.h"
#include "engine/io/homes/model_library.h"

#include <string>
#include <vector>

namespace dollytrack::generate {

/// Converts a placed piece to a piece of a home.
homes::HomePiece homePiece(const PlacedPiece& placed, const std::string& name);

/// The triangles of a placed piece, in the room's frame.
std::vector<TriangleInRoom> trianglesOf(const homes::FurnitureModel& model,
                                        const PlacedPiece& placed);

}  // namespace dollytrack::generate
