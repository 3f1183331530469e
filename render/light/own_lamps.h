#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// A lamp that the scene has, standing or on a wall: a small ball that shines evenly all around,
/// within the object's shade. Cameras see the object alone, as it ever was.
struct OwnLamp {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of its middle, m
    double radius_m = 0.05;
    double intensity = 0.1;  // irradiance at 1 m of what faces it; see Lamp
    OrientedBox shade;       // holds the ball; what is in it casts no shadow of this lamp
    int object_id = 0;

    /// The ball's radius as it is seen from a place: one within the ball, on a shade that the ball
    /// does not fit into, is lit by a smaller one.
    [[nodiscard]] double radiusFrom(const Eigen::Vector3d& place) const;
    /// Of the ball with that radius.
    [[nodiscard]] double radianceFrom(const Eigen::Vector3d& place) const;
    /// How far light on its way to the ball, `distance` m along a unit vector, may be shadowed.
    [[nodiscard]] double shadowedFor(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                     double distance) const;
};

/// A bulb in a shade, as a share of the light straight below one of the rooms' own lamps. It sends
/// a sixth of the light that such a one does: 0.3 m away a wall is about twice as bright with it,
/// a room as a whole hardly.
constexpr double kOwnIntensity = 0.04;

/// More do not take part; the largest do.
constexpr std::size_t kMostOwnLamps = 64;

/// The lamps among the scene's objects but for those `taken` (by id - 1), largest first. The ball
/// is in the upper third of what stands on something, in the lower one of what hangs long, else in
/// the middle; the shade is the object's box up to the walls it reaches.
[[nodiscard]] std::vector<OwnLamp> findOwnLamps(const Scene& scene, const RayCaster& rays,
                                                const std::vector<bool>& taken);

}  // namespace dollytrack::render
