#pragma once

#include "engine/camera/trajectory.h"
#include "engine/scene/scene.h"
#include "render/frames/object_motion.h"

#include <vector>

namespace dollytrack::render {

/// Where the things that move are between the frames: the middle of each thing's box goes straight
/// on and it turns evenly from frame to frame, as tracks have it between their keys; at rest before
/// the first frame and after the last. Const, many threads.
class ObjectPaths {
  public:
    /// `motions` are over the trajectory's frames.
    ObjectPaths(const Scene& scene, const Trajectory& trajectory,
                std::vector<ObjectMotion> motions);

    [[nodiscard]] bool any() const { return !motions_.empty(); }

    struct Placed {
        int object_id = 0;
        Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  // as in ObjectMotion
    };
    [[nodiscard]] std::vector<Placed> at(double time_s) const;

  private:
    std::vector<double> times_;
    std::vector<ObjectMotion> motions_;
    std::vector<Eigen::Vector3d> middles_;  // of the boxes at rest
};

}  // namespace dollytrack::render
