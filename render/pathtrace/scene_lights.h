#pragma once

#include "engine/scene/scene.h"
#include "render/light/light_rig.h"
#include "render/materials/traced_surface.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// A randomly sampled point on a light source.
struct LightSample {
    Eigen::Vector3d way = Eigen::Vector3d::UnitZ();  // unit vector towards it
    double distance = 0.0;                           // m
    double free = 0.0;                               // m, length that must be unobstructed
    double density = 0.0;                            // of the sampled direction, 1/sr
    Eigen::Vector3f radiance = Eigen::Vector3f::Zero();
};

/// Samples a scene's light sources: the rig's lamps by unshadowed strength, and emitting triangles
/// and windows by their power. Keeps references.
class SceneLights {
  public:
    SceneLights(const Scene& scene, const TracedSurface& surface, const LightRig& rig);

    [[nodiscard]] std::optional<LightSample> sampleLamp(const Eigen::Vector3d& from, double which,
                                                        const std::array<double, 2>& where) const;
    [[nodiscard]] std::optional<LightSample> sampleTriangle(
        const Eigen::Vector3d& from, double which, const std::array<double, 2>& where) const;

    /// Visits the lamps that a ray hits and whose unobstructed length ends in [begin, end) along
    /// it; a lamp's shade (see kLampShade) is no obstacle. Calls visit(radiance, density of
    /// sampleLamp()).
    template <class Visit>
    void visitLamps(const Eigen::Vector3d& from, const Eigen::Vector3d& way, double begin,
                    double end, Visit&& visit) const {
        for (const SceneLamp& lamp : rig_.scene_lamps) {
            const std::optional<double> distance = toBall(lamp, from, way);
            if (!distance) continue;
            const double free = lamp.shadowedFor(from, way, *distance);
            if (free < begin || free >= end) continue;
            visit(lampRadiance(lamp, from),
                  choice(lamp, from) / totalChoice(from) / cone(lamp, from));
        }
        if (way.z() <= 0.0) return;
        for (const Lamp& lamp : rig_.lamps) {
            const double distance = (lamp.position.z() - from.z()) / way.z();
            const double free = std::max(distance - kLampShade, 0.0);
            if (distance <= 0.0 || free < begin || free >= end) continue;
            const Eigen::Vector3d at = from + distance * way - lamp.position;
            if (at.squaredNorm() > lamp.radius_m * lamp.radius_m) continue;
            const double density = choice(lamp, from) / totalChoice(from) * distance * distance /
                                   (lamp.area() * way.z());
            visit(lampRadiance(lamp), density);
        }
    }

    /// Density, 1/sr, with which sampleTriangle() chooses this point.
    [[nodiscard]] double triangleDensity(int object_id, std::uint32_t triangle,
                                         const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& at) const;

  private:
    [[nodiscard]] double choice(const Lamp& lamp, const Eigen::Vector3d& from) const;
    [[nodiscard]] double choice(const SceneLamp& lamp, const Eigen::Vector3d& from) const;
    /// Solid angle of the lamp's ball, sr; see SceneLamp::radiusFrom().
    [[nodiscard]] static double cone(const SceneLamp& lamp, const Eigen::Vector3d& from);
    /// Distance along a ray, with unit direction `way`, to the lamp's ball; nullopt if it misses.
    [[nodiscard]] static std::optional<double> toBall(const SceneLamp& lamp,
                                                      const Eigen::Vector3d& from,
                                                      const Eigen::Vector3d& way);
    [[nodiscard]] LightSample sampleBall(const SceneLamp& lamp, const Eigen::Vector3d& from,
                                         const std::array<double, 2>& where) const;
    [[nodiscard]] double totalChoice(const Eigen::Vector3d& from) const;
    [[nodiscard]] Eigen::Vector3f lampRadiance(const Lamp& lamp) const {
        return rig_.lampLight() * static_cast<float>(lamp.radiance());
    }
    [[nodiscard]] Eigen::Vector3f lampRadiance(const SceneLamp& lamp,
                                               const Eigen::Vector3d& from) const {
        return rig_.sceneLampLight() * static_cast<float>(lamp.radianceFrom(from));
    }
    /// Mean radiance of a triangle, by which triangles are chosen.
    [[nodiscard]] double brightness(int object_id, std::uint32_t triangle) const;

    struct Emitter {
        std::uint32_t triangle;
        int object_id;
    };

    const Scene& scene_;
    const TracedSurface& surface_;
    const LightRig& rig_;
    std::vector<Emitter> emitters_;
    std::vector<float> emission_;  // by material: mean emission
    std::vector<float> shines_;    // by id - 1: factor of emission
    std::vector<double> power_;    // cumulative power by triangle, in W/sr up to a factor
};

}  // namespace dollytrack::render
