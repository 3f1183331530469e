#pragma once

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::render {

/// Where one object is in each frame of a dataset.
struct ObjectMotion {
    int object_id = 0;
    /// World; by frame: p_then = motion * p, for a point p of the object in the scene as given.
    std::vector<Eigen::Isometry3d> by_frame;
};

/// "mug on table"
struct ObjectRelation {
    int object_id = 0;
    const char* kind = "";  // "on", "in", "hangs_on"
    int other_id = 0;
};

}  // namespace dollytrack::render
