#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack {
class RayCaster;
struct Intrinsics;
struct Pose;
}  // namespace dollytrack

namespace dollytrack::render {

/// Visibility of a pixel's surface point in another image, as stored in the masks beside flow and
/// disparity.
enum class PixelVisibility : std::uint8_t {
    Seen = 0,
    Occluded = 1,
    Outside = 2,    // outside the other image, or nearer than its near plane
    Nothing = 255,  // the pixel hits nothing
};

/// Visibility of world points from another camera, by ray casts. A surface less than 2 mm (plus
/// rounding) in front of a point counts as the point's own surface. Entries with `nothing[i]`
/// become PixelVisibility::Nothing.
[[nodiscard]] std::vector<PixelVisibility> visibilityFrom(const RayCaster& rays, const Pose& camera,
                                                          const Intrinsics& lens, double near_m,
                                                          std::span<const Eigen::Vector3d> places,
                                                          const std::vector<bool>& nothing);

}  // namespace dollytrack::render
