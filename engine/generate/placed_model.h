#pragma once

#include "engine/generate/room_layout.h"
#include "engine/io/homes/home.h"
#include "engine/io/homes/model_library.h"

#include <string>
#include <vector>

namespace dollytrack::generate {

/// A placed piece as one of a home.
homes::HomePiece homePiece(const PlacedPiece& placed, const std::string& name);

/// A piece's triangles where they stand in the room.
std::vector<TriangleInRoom> trianglesOf(const homes::FurnitureModel& model,
                                        const PlacedPiece& placed);

}  // namespace dollytrack::generate
