#pragma once

#include "engine/camera/picture_params.h"
#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/light/light_volume.h"
#include "render/light/sun_rays.h"
#include "render/materials/traced_surface.h"
#include "render/view/view.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::render {

/// Ray-traced reflections on the smooth surfaces of a drawn image. Reflected surfaces are shaded
/// from the light volume; rays continue at further mirrors. Thread-safe. Keeps references to scene,
/// rays, light and moved shape.
class TracedReflections {
  public:
    /// @param moved  current vertex positions if objects moved, else null; `rays` must match
    TracedReflections(const Scene& scene, const RayCaster& rays, const LightVolume& light,
                      const MovedShape* moved = nullptr);

    TracedReflections(const TracedReflections&) = delete;  // members refer to each other
    TracedReflections& operator=(const TracedReflections&) = delete;

    /// Whether a scene has any surface whose reflections would be traced.
    [[nodiscard]] static bool any(const Scene& scene, Reflections which);

    /// Traces the reflections at pixel centres, for the surfaces that View::reflections selects.
    /// Each pixel gets the reflected light in units of LightVolume::ambient and, as fourth value,
    /// the share of the ambient reflection that it replaces. Only rows first_row to last_row - 1
    /// are written. Returns false if no such surface is in view. Objects that the view hides or
    /// cuts are still mirrored.
    [[nodiscard]] bool trace(const View& view, int first_row, int last_row,
                             std::vector<Eigen::Vector4f>& image) const;

  private:
    [[nodiscard]] Eigen::Vector4f seenIn(const View& view, double x, double y) const;
    [[nodiscard]] Eigen::Vector3f lightAlong(Eigen::Vector3d origin, Eigen::Vector3d way) const;
    /// Light from a surface point without its own reflections.
    [[nodiscard]] Eigen::Vector3f lightOf(const SurfacePoint& point, int object_id) const;

    const Scene& scene_;
    const RayCaster& rays_;
    const LightVolume& light_;
    TracedSurface surface_;
    SunRays sun_rays_;
    std::vector<bool> outside_;  // by id - 1, see showsOutside()
    /// An object with smooth surfaces.
    struct Smooth {
        int id;
        bool mirrors;  // has mirrors, which are traced with Reflections::Mirrors, too
        Eigen::AlignedBox3f box;
    };
    std::vector<Smooth> smooth_;
};

}  // namespace dollytrack::render
