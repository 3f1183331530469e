#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {
class RayCaster;
struct Intrinsics;
}  // namespace dollytrack

namespace dollytrack::planning {

/// A sample of a surface; it stands for an area about `spacing_m` wide.
struct SurfacePatch {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit length; patches are two-sided
};

struct SurfacePatches {
    std::vector<SurfacePatch> patches;
    double spacing_m = 0.0;  // edge length of the grid cells; may exceed the requested one to limit
                             // the number of patches
};

/// Patches of all surfaces in a box, at most one per grid cell of edge `spacing_m` and dominant
/// axis of the normal. The spacing is enlarged so that there are at most 6000.
SurfacePatches patchesIn(const Scene& scene, const OrientedBox& box, double spacing_m);

/// Cosine of 80 degrees, the largest angle between line of sight and normal at which a patch counts
/// as seen.
inline constexpr double kFlattestSightCosine = 0.17364817766693036;

/// Visibility of patches from a point, for any viewing direction: the line of sight is free, meets
/// the surface within 80 degrees of its normal, and the patch is large enough in the image.
class PatchSight {
  public:
    /// A patch must be at least 8 pixels wide in an image of these intrinsics.
    PatchSight(const RayCaster& rays, const Intrinsics& intrinsics, double spacing_m);

    [[nodiscard]] bool reaches(const Eigen::Vector3d& from, const SurfacePatch& patch) const;
    [[nodiscard]] double farthest_m() const { return farthest_m_; }

  private:
    const RayCaster& rays_;
    double farthest_m_;
};

}  // namespace dollytrack::planning
