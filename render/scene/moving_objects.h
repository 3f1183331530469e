#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/materials/traced_surface.h"
#include "render/scene/object_motion.h"

#include <Eigen/Geometry>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// A scene with objects that move from frame to frame. Keeps references. Thread-safe.
class MovingObjects {
  public:
    /// `rays` must cast against the scene in its own positions.
    MovingObjects(const Scene& scene, const RayCaster& rays, std::vector<ObjectMotion> motions);

    [[nodiscard]] bool any() const { return !motions_.empty(); }
    [[nodiscard]] const std::vector<ObjectMotion>& motions() const { return motions_; }

    /// Each object's motion from one frame's time to another's, by id (index 0 is unused), world
    /// frame. Empty if nothing moves.
    [[nodiscard]] std::vector<Eigen::Isometry3d> between(int from, int to) const;

    /// Motion from a frame's time back to the scene's own positions; format as between().
    [[nodiscard]] std::vector<Eigen::Isometry3d> toRest(int from) const;

    /// Ray caster for the scene at a frame's time.
    [[nodiscard]] std::shared_ptr<const RayCaster> raysAt(int frame) const;

    /// World positions and normals of one object's vertices in a frame.
    struct Shape {
        std::vector<Eigen::Vector3f> positions;
        std::vector<Eigen::Vector3f> normals;
    };
    [[nodiscard]] Shape shapeAt(const ObjectMotion& motion, int frame) const;
    /// The same for the whole scene; none if nothing moves.
    [[nodiscard]] std::optional<MovedShape> wholeShapeAt(int frame) const;

  private:
    const Scene& scene_;
    const RayCaster& rays_;
    std::vector<ObjectMotion> motions_;  // by increasing object id
    mutable std::mutex mutex_;
    mutable Scene moved_;  // vertex positions of the last frame requested
    mutable std::map<int, std::shared_ptr<const RayCaster>> cache_;  // recently requested frames
};

}  // namespace dollytrack::render
