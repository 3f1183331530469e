#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

/// `count` unit directions, evenly distributed over the sphere (Fibonacci lattice), from the top
/// down.
std::vector<Eigen::Vector3d> directionsOnSphere(int count);

/// Distinguishes scans from modelled scenes, and front from back hits in a scan. A scan knows
/// surfaces only from the side of the scanner; space behind them, and openings without surface, are
/// unobserved. In a modelled scene backs and openings are intended. Keeps a reference.
class ScannedSurfaces {
  public:
    explicit ScannedSurfaces(const Scene& scene);

    /// Whether the scene is a scan: it was made from a point cloud, or is a mesh of at least 2000
    /// triangles with at least 90 % of its area in triangles with edges of at most 0.2 m. Modelled
    /// walls, floors and ceilings have large triangles.
    [[nodiscard]] bool isScan() const { return is_scan_; }

    enum class HitSide { Nothing, Front, Back };
    /// Side of the surface that a ray with this direction hit. Nothing: no hit, or a hit on the
    /// floor that was added under a point cloud. If the triangles do not mostly face the room's
    /// centre, their orientation is unreliable and every hit counts as Front.
    [[nodiscard]] HitSide hitSide(const RayHit& hit, const Eigen::Vector3d& direction) const;

  private:
    const Scene* scene_;
    bool is_scan_ = false;
    bool fronts_known_ = false;
};

}  // namespace dollytrack::planning
