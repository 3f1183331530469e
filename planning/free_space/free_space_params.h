#pragma once

#include "engine/core/fields.h"

namespace dollytrack::planning {

/// Settings of the map of free space.
struct FreeSpaceParams {
    double octree_resolution_m = 0.05;

    bool operator==(const FreeSpaceParams&) const = default;
};

template <class Params, class Visitor>
void visitFreeSpaceParams(Params& p, Visitor&& visit) {
    visit("octree_resolution_m", p.octree_resolution_m,
          FieldInfo{0.01, 0.5, "m", "Edge of the smallest cell of the map of free space", "T"});
}

}  // namespace dollytrack::planning
