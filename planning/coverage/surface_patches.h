#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {
class RayCaster;
struct Intrinsics;
}  // namespace dollytrack

namespace dollytrack::planning {

/// A piece of surface about as wide as the spacing it was sampled with.
struct SurfacePatch {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit; a patch has two sides
};

struct SurfacePatches {
    std::vector<SurfacePatch> patches;
    double spacing_m = 0.0;  // more than asked for where there would be too many
};

/// Patches of all surfaces in a box: at most one a cube of `spacing_m` and direction of surface.
SurfacePatches patchesIn(const Scene& scene, const OrientedBox& box, double spacing_m);

/// A surface that is met at more than 80 degrees from its normal is not seen.
inline constexpr double kFlattestSightCosine = 0.17364817766693036;

/// Whether an eye at a place sees patches, whatever it looks along: nothing is in between, the
/// surface is met at 80 degrees from its normal or less, and the patch is not too small.
class PatchSight {
  public:
    /// A patch must be 8 pixels wide in this image.
    PatchSight(const RayCaster& rays, const Intrinsics& intrinsics, double spacing_m);

    [[nodiscard]] bool reaches(const Eigen::Vector3d& from, const SurfacePatch& patch) const;
    [[nodiscard]] double farthest_m() const { return farthest_m_; }

  private:
    const RayCaster& rays_;
    double farthest_m_;
};

}  // namespace dollytrack::planning
