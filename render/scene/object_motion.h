#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace dollytrack::render {

/// Motion of one object through the frames of a dataset.
struct ObjectMotion {
    int object_id = 0;
    /// By frame, world frame: p_then = motion * p, for a point p of the object in the scene.
    std::vector<Eigen::Isometry3d> by_frame;
};

/// An object's motion in a frame; identity if it does not move.
[[nodiscard]] inline Eigen::Isometry3d motionOf(const std::vector<ObjectMotion>& motions,
                                                int object_id, std::size_t frame) {
    for (const ObjectMotion& motion : motions) {
        if (motion.object_id == object_id) return motion.by_frame[frame];
    }
    return Eigen::Isometry3d::Identity();
}

/// A relation between two objects, for example "mug on table".
struct ObjectRelation {
    int object_id = 0;
    const char* kind = "";  // "on", "in", "hangs_on"
    int other_id = 0;
};

}  // namespace dollytrack::render
