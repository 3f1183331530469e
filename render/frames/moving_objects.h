#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/frames/object_motion.h"
#include "render/pathtrace/traced_surface.h"

#include <Eigen/Geometry>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// A scene of which some objects move from frame to frame. Keeps references. Const, many threads.
class MovingObjects {
  public:
    /// `rays` are of the scene as given.
    MovingObjects(const Scene& scene, const RayCaster& rays, std::vector<ObjectMotion> motions);

    [[nodiscard]] bool any() const { return !motions_.empty(); }
    [[nodiscard]] const std::vector<ObjectMotion>& motions() const { return motions_; }

    /// The objects' motions from one frame's time to another's, by id; index 0 is no object. Empty
    /// where nothing moves.
    [[nodiscard]] std::vector<Eigen::Isometry3d> between(int from, int to) const;

    /// From a frame's time to the scene as given; the same.
    [[nodiscard]] std::vector<Eigen::Isometry3d> toRest(int from) const;

    /// The scene's triangles as they are in a frame.
    [[nodiscard]] std::shared_ptr<const RayCaster> raysAt(int frame) const;

    /// Corners and normals of a moving object in a frame, from its first vertex on; world.
    struct Shape {
        std::vector<Eigen::Vector3f> positions;
        std::vector<Eigen::Vector3f> normals;
    };
    [[nodiscard]] Shape shapeAt(const ObjectMotion& motion, int frame) const;
    /// The whole scene's; none where nothing moves.
    [[nodiscard]] std::optional<MovedShape> wholeShapeAt(int frame) const;

  private:
    const Scene& scene_;
    const RayCaster& rays_;
    std::vector<ObjectMotion> motions_;  // by rising id
    mutable std::mutex mutex_;
    mutable Scene moved_;  // geometry alone, as it was asked for last
    mutable std::map<int, std::shared_ptr<const RayCaster>> cache_;  // of the last few frames asked
};

}  // namespace dollytrack::render
