#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/home_materials.h"
#include "engine/io/homes/surface_mesh.h"
#include "engine/io/homes/wall_outline.h"

namespace dollytrack::homes {

/// Height above the plan's 0 at which the pieces and floors of a level begin.
double levelElevation(const Home& home, int level);

/// A wall with its top, ends and baseboards, and with a hole for every door and window that stands
/// in it: cut out by its shape through the whole thickness, the sides of the cut closed.
SurfaceMesh buildWall(const Home& home, const HomeWall& wall,
                      const std::vector<WallStretch>& outline, HomeMaterials& materials);

}  // namespace dollytrack::homes
