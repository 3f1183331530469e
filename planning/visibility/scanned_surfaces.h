#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

/// Unit directions spread evenly over the sphere (a Fibonacci lattice).
std::vector<Eigen::Vector3d> directionsOnSphere(int count);

/// Tells scans from modelled scenes, and what a ray met in a scan. A scan shows surfaces from the
/// side that the scanner saw; behind them, and where there are none, nothing is known. In a
/// modelled scene the back of a surface and an open side are as meant. Keeps a reference.
class ScannedSurfaces {
  public:
    explicit ScannedSurfaces(const Scene& scene);

    /// Whether the scene was scanned: it was made of a point cloud, or nearly all of its surface is
    /// a fine mesh. Modelled walls, floors and ceilings have large triangles.
    [[nodiscard]] bool isScan() const { return is_scan_; }

    enum class Met { Nothing, Front, Back };
    /// A floor that was put under a point cloud counts as nothing. Where most of the triangles face
    /// away from the room their order says nothing, and each side counts as the front.
    [[nodiscard]] Met met(const RayHit& hit, const Eigen::Vector3d& direction) const;

  private:
    const Scene* scene_;
    bool is_scan_ = false;
    bool fronts_known_ = false;
};

}  // namespace dollytrack::planning
