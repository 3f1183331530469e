#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/home_materials.h"
#include "engine/io/homes/surface_mesh.h"
#include "engine/io/homes/wall_outline.h"

namespace dollytrack::homes {

/// Elevation of a level's floor; 0 for level -1.
double levelElevation(const Home& home, int level);

/// Builds a wall with its top, ends and baseboards, and with a hole through its whole thickness for
/// every door and window in it. The holes have the openings' shapes and closed sides.
SurfaceMesh buildWall(const Home& home, const HomeWall& wall,
                      const std::vector<WallSegment>& outline, HomeMaterials& materials);

}  // namespace dollytrack::homes
