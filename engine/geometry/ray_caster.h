#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace dollytrack {

struct RayHit {
    int object_id = 0;           // 0: nothing hit
    double distance = 0.0;       // in lengths of the direction given
    std::uint32_t triangle = 0;  // index into Scene::triangles
};

struct ClosestPoint {
    int object_id = 0;  // 0: nothing within the radius asked for
    double distance = std::numeric_limits<double>::infinity();  // m
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/// Ray casts and closest-point queries on a scene's triangles, by Embree's bounding volume
/// hierarchies. Keeps a copy of the geometry, so the scene may be destroyed. All queries are const
/// and thread-safe. A ray hits nothing if its origin or direction is not finite or beyond 1e18.
class RayCaster {
  public:
    explicit RayCaster(const Scene& scene);
    /// Builds the ray caster of a scene from that of an earlier scene, of which only the `moved`
    /// objects (rising ids, see movedObjects()) are elsewhere. It answers as one built from the
    /// scene alone; the unmoved objects' hierarchies are shared.
    RayCaster(const Scene& scene, const RayCaster& before, const std::vector<int>& moved);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    /// The first surface along origin + t * direction with min_distance < t < max_distance.
    /// Triangles are hit from both sides.
    [[nodiscard]] RayHit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double max_distance = std::numeric_limits<double>::infinity(),
                              double min_distance = 0.0) const;

    /// A ray of a bundle. Its length is measured in lengths of its direction.
    struct BundleRay {
        Eigen::Vector3d direction;
        float max_distance = std::numeric_limits<float>::infinity();
    };

    /// Casts many rays from one point, much faster than one by one if neighbours in the list have
    /// similar directions. hits[i] belongs to rays[i].
    void castBundle(const Eigen::Vector3d& origin, std::span<const BundleRay> rays,
                    double min_distance, std::vector<RayHit>& hits) const;

    /// Whether the ray hits this object, all other objects ignored.
    [[nodiscard]] bool meetsObject(
        int object_id, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
        double max_distance = std::numeric_limits<double>::infinity()) const;

    /// Whether no surface intersects the segment between two points, its ends excluded.
    [[nodiscard]] bool sees(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// Closest surface point within `max_distance`.
    [[nodiscard]] ClosestPoint closest(
        const Eigen::Vector3d& point,
        double max_distance = std::numeric_limits<double>::infinity()) const;

    /// The closest point on one object's surface, all other objects ignored.
    [[nodiscard]] ClosestPoint closestOn(
        int object_id, const Eigen::Vector3d& point,
        double max_distance = std::numeric_limits<double>::infinity()) const;

    /// Whether no surface lies nearer than `distance`. Faster than closest().
    [[nodiscard]] bool isClear(const Eigen::Vector3d& point, double distance) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack
