#pragma once

#include "engine/core/fields.h"

namespace dollytrack::planning {

/// Resolution of the free space map, and height band of the camera. Heights are above the floor
/// below the camera (see floor_heights.h).
struct FreeSpaceParams {
    double octree_resolution_m = 0.05;
    double min_height_m = 0.0;
    double max_height_m = 100.0;

    bool operator==(const FreeSpaceParams&) const = default;
};

template <class Params, class Visitor>
void visitFreeSpaceParams(Params& p, Visitor&& visit) {
    visit("octree_resolution_m", p.octree_resolution_m,
          FieldInfo{0.01, 0.5, "m", "Edge length of the smallest cell of the free-space map", "T"});
    visit("min_height_m", p.min_height_m,
          FieldInfo{0, 100, "m", "Lowest height of the camera above the floor below it"});
    visit("max_height_m", p.max_height_m,
          FieldInfo{0, 100, "m", "Greatest height of the camera above the floor below it"});
}

}  // namespace dollytrack::planning
