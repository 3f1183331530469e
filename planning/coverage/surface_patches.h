#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <limits>
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

/// The positions from which a patch counts as seen.
struct VisibilityRules {
    double farthest_m = std::numeric_limits<double>::infinity();
    double flattest_cosine = kFlattestSightCosine;  // of line of sight and normal
    bool two_sided = true;                          // else only from the side of the normal
};

/// Visibility of patches from a point, for any viewing direction: the line of sight is free and
/// keeps to the rules.
class PatchVisibility {
  public:
    PatchVisibility(const RayCaster& rays, const VisibilityRules& rules);
    /// A patch must be at least 8 pixels wide in an image of these intrinsics; it is seen within 80
    /// degrees of its normal, from both sides.
    PatchVisibility(const RayCaster& rays, const Intrinsics& intrinsics, double spacing_m);

    /// Whether a view keeps to the rules, if nothing is in between.
    [[nodiscard]] bool faces(const Eigen::Vector3d& from, const SurfacePatch& patch) const;
    [[nodiscard]] bool reaches(const Eigen::Vector3d& from, const SurfacePatch& patch) const;
    [[nodiscard]] double farthest_m() const { return rules_.farthest_m; }

    /// A line of sight that ends this close before a patch, m, still reaches it.
    static constexpr double kReached_m = 0.01;

  private:
    const RayCaster& rays_;
    VisibilityRules rules_;
};

}  // namespace dollytrack::planning
