#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/home_materials.h"
#include "engine/io/homes/surface_mesh.h"

namespace dollytrack::homes {

/// A room's floor; on upper levels staircases from below cut their holes into it, whose sides are
/// as thick as the floor. Empty where the home shows none.
SurfaceMesh buildFloor(const Home& home, const HomeRoom& room, HomeMaterials& materials);

/// A room's ceiling: at its level's height, on the last level along the tops of the nearest walls;
/// staircases through it cut their holes. Empty where the home shows none.
SurfaceMesh buildCeiling(const Home& home, const HomeRoom& room, HomeMaterials& materials);

}  // namespace dollytrack::homes
