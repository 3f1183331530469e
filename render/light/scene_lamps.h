#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// A lamp that is an object of the scene: standing, on a wall, or hanging where no room lamp takes
/// its place. Its light comes from a small
/// uniform ball within the object's shade. Cameras see the object, not the ball.
struct SceneLamp {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // centre, m
    double radius_m = 0.05;
    double intensity = 0.1;  // irradiance at 1 m on a surface facing it; see Lamp
    OrientedBox shade;       // contains the ball; nothing inside it casts a shadow of this lamp
    int object_id = 0;

    /// Apparent radius of the ball from a point. It shrinks near and inside the ball, so that a
    /// shade too small for the ball is lit, too.
    [[nodiscard]] double radiusFrom(const Eigen::Vector3d& place) const;
    /// Radiance of the ball with that radius.
    [[nodiscard]] double radianceFrom(const Eigen::Vector3d& place) const;
    /// Length over which a ray towards the ball can be shadowed: up to the shade.
    /// @param way       unit vector towards a point of the ball
    /// @param distance  to that point, m
    [[nodiscard]] double shadowedFor(const Eigen::Vector3d& from, const Eigen::Vector3d& way,
                                     double distance) const;
};

/// Intensity of a scene lamp relative to a room lamp. It emits a sixth of a room lamp's light: a
/// wall 0.3 m away gets about twice as bright, the room hardly.
constexpr double kSceneLampIntensity = 0.04;

/// Largest number of scene lamps; if a scene has more, the largest ones are used.
constexpr std::size_t kMaxSceneLamps = 64;

/// Finds the lamps among the scene's objects except those `taken` (by id - 1), largest first. The
/// ball is in the upper third of a standing lamp, in the lower third of a long hanging lamp, else
/// in the middle. The shade is the object's box, clipped at walls.
[[nodiscard]] std::vector<SceneLamp> findSceneLamps(const Scene& scene, const RayCaster& rays,
                                                    const std::vector<bool>& taken);

}  // namespace dollytrack::render
