#pragma once

#include "engine/core/fields.h"

namespace dollytrack {

/// How a point cloud becomes a room.
struct CloudParams {
    double voxel_m = 0.02;     // edge length of voxels; one point per voxel is kept
    int max_points = 150'000;  // largest number of points; the voxels grow until it is met
    double gap_m = 0.1;        // largest gap across which surfaces are joined
    double hole_m = 0.4;       // largest width of holes that are filled
    double plane_m = 0.03;     // largest distance of a wall's or floor's points from its plane
    double object_m = 0.12;    // smallest diagonal of an object
    bool operator==(const CloudParams&) const = default;
};

/// The only list of these fields; flags and the project's import section are generated from it.
template <class Params, class Visitor>
void visitCloudParams(Params& p, Visitor&& visit) {
    visit.beginSection("cloud");
    visit("voxel_m", p.voxel_m,
          FieldInfo{0.002, 0.5, "m", "Detail: one point is kept in each cube of this size"});
    visit("max_points", p.max_points,
          FieldInfo{100, 2e6, "",
                    "Largest number of points kept; the cubes are enlarged until it is met"});
    visit("gap_m", p.gap_m,
          FieldInfo{0.005, 2.0, "m", "Largest gap across which surfaces are joined"});
    visit("hole_m", p.hole_m, FieldInfo{0.0, 5.0, "m", "Holes up to this wide are filled"});
    visit("plane_m", p.plane_m,
          FieldInfo{0.005, 0.3, "m",
                    "Largest distance of the points of a wall or floor from its plane"});
    visit("object_m", p.object_m,
          FieldInfo{0.02, 2.0, "m", "Smallest diagonal of a separate object"});
}

}  // namespace dollytrack
