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

/// Exact questions about a scene's triangles, answered through Embree's trees. Holds a copy of the
/// geometry, so the scene may go. All questions are const and may be asked from many threads.
class RayCaster {
  public:
    explicit RayCaster(const Scene& scene);
    /// The same as of the scene alone, made of an earlier one of which these objects (by rising id)
    /// have moved; see movedObjects(). What it holds of the others is shared.
    RayCaster(const Scene& scene, const RayCaster& before, const std::vector<int>& moved);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    /// First surface along origin + t * direction with min_distance < t < max_distance. Both
    /// sides of a triangle count.
    [[nodiscard]] RayHit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double max_distance = std::numeric_limits<double>::infinity(),
                              double min_distance = 0.0) const;

    /// A ray of a bundle, and how far it goes, in lengths of its direction.
    struct BundleRay {
        Eigen::Vector3d direction;
        float max_distance = std::numeric_limits<float>::infinity();
    };

    /// The same for many rays from one point, much faster when neighbours in the list point nearly
    /// alike. hits[i] belongs to rays[i].
    void castBundle(const Eigen::Vector3d& origin, std::span<const BundleRay> rays,
                    double min_distance, std::vector<RayHit>& hits) const;

    /// Whether the ray would meet `object_id` if that stood alone in empty space.
    [[nodiscard]] bool meetsObject(
        int object_id, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
        double max_distance = std::numeric_limits<double>::infinity()) const;

    /// Whether the open segment between two points is free of surfaces.
    [[nodiscard]] bool sees(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// Closest surface point within `max_distance`.
    [[nodiscard]] ClosestPoint closest(
        const Eigen::Vector3d& point,
        double max_distance = std::numeric_limits<double>::infinity()) const;

    /// The same of one object's surface, whatever else is nearer.
    [[nodiscard]] ClosestPoint closestOn(
        int object_id, const Eigen::Vector3d& point,
        double max_distance = std::numeric_limits<double>::infinity()) const;

    /// Whether no surface lies nearer than `distance`; quicker than to ask for the closest one.
    [[nodiscard]] bool isClear(const Eigen::Vector3d& point, double distance) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack
