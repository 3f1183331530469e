#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/home_materials.h"
#include "engine/io/homes/surface_mesh.h"

namespace dollytrack::homes {

/// Builds a room's floor. On upper levels it has holes for staircases from below, as deep as the
/// floor is thick. Empty if the floor is hidden.
SurfaceMesh buildFloor(const Home& home, const HomeRoom& room, HomeMaterials& materials);

/// Builds a room's ceiling, with holes for staircases: at its level's height, or on the top level
/// at the height of the nearest walls. Empty if the ceiling is hidden.
SurfaceMesh buildCeiling(const Home& home, const HomeRoom& room, HomeMaterials& materials);

}  // namespace dollytrack::homes
