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

/// What becomes of a pixel's surface in another picture. Values of the masks that stand beside flow
/// and disparity.
enum class Sight : std::uint8_t {
    Seen = 0,
    Occluded = 1,
    Outside = 2,    // of the other picture, or behind its camera
    Nothing = 255,  // the pixel sees nothing
};

/// Whether what lies at these places, world, is seen from another camera, by exact rays. A surface
/// less than 2 mm before a place counts as the same one. `nothing[i]`: there is no place.
[[nodiscard]] std::vector<Sight> sightFrom(const RayCaster& rays, const Pose& camera,
                                           const Intrinsics& lens, double near_m,
                                           std::span<const Eigen::Vector3d> places,
                                           const std::vector<bool>& nothing);

}  // namespace dollytrack::render
