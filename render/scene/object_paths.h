#pragma once

#include "engine/camera/trajectory.h"
#include "engine/scene/scene.h"
#include "render/scene/object_motion.h"

#include <vector>

namespace dollytrack::render {

/// Positions of moving objects between frames: the centre of each object's box is interpolated
/// linearly, its rotation by slerp. Before the first frame and after the last, objects stand still.
/// Thread-safe.
class ObjectPaths {
  public:
    /// `motions` must cover all frames of the trajectory.
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
    std::vector<Eigen::Vector3d> middles_;  // box centres in the scene's own positions
};

}  // namespace dollytrack::render
