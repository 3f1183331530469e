#pragma once

#include "engine/scene/scene.h"

namespace dollytrack::test {

/// A building of rooms 5 x 4 x 2.6 m in a nearly square grid, connected by doors, with 25 targets
/// per room: bed, wardrobe, shelf, sofa, table, chairs, pictures, lamp, and small objects on and in
/// them. Some sizes and positions vary with the seed. The last furnished room has the rest of
/// `objects`.
Scene furnishedBuilding(int objects, unsigned seed = 1);

}  // namespace dollytrack::test
