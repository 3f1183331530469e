#pragma once

#include "engine/scene/scene.h"

namespace dollytrack::test {

/// Rooms of 5 x 4 x 2.6 m in a square grid, joined by doors, with 25 targets each: bed, wardrobe,
/// shelf, sofa, a table with chairs, pictures, a lamp, and small things on and in them. Sizes and
/// places vary with the seed. The last room has what is left of `objects`.
Scene furnishedBuilding(int objects, unsigned seed = 1);

}  // namespace dollytrack::test
