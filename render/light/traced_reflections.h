#pragma once

#include "engine/camera/picture_params.h"
#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/draw/view.h"
#include "render/light/light_volume.h"
#include "render/pathtrace/sun_rays.h"
#include "render/pathtrace/traced_surface.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::render {

/// What the smooth surfaces of a drawn picture reflect, found by rays: those that meet a mirror go
/// on to what it shows, which is lit as drawn surfaces are. Const and for many threads; keeps
/// references to scene, rays, light and shape.
class TracedReflections {
  public:
    /// @param moved  where things are if not where the scene has them; `rays` are of them there
    TracedReflections(const Scene& scene, const RayCaster& rays, const LightVolume& light,
                      const MovedShape* moved = nullptr);

    TracedReflections(const TracedReflections&) = delete;  // parts refer to each other
    TracedReflections& operator=(const TracedReflections&) = delete;

    /// Whether a scene has any surface that would be asked about.
    [[nodiscard]] static bool any(const Scene& scene, Reflections which);

    /// What each pixel's middle sees in such smooth surfaces as View::reflections names, in the
    /// units of LightVolume::ambient; fourth: the share of the room's blurred light that this takes
    /// the place of. Rows from first_row to before last_row; others stay as they are. False: no
    /// such surface is in view. What the view hides or cuts away is mirrored nevertheless.
    [[nodiscard]] bool trace(const View& view, int first_row, int last_row,
                             std::vector<Eigen::Vector4f>& image) const;

  private:
    [[nodiscard]] Eigen::Vector4f seenIn(const View& view, double x, double y) const;
    [[nodiscard]] Eigen::Vector3f lightAlong(Eigen::Vector3d origin, Eigen::Vector3d way) const;
    /// Without what it reflects.
    [[nodiscard]] Eigen::Vector3f lightOf(const SurfacePoint& point, int object_id) const;

    const Scene& scene_;
    const RayCaster& rays_;
    const LightVolume& light_;
    TracedSurface surface_;
    SunRays sun_rays_;
    std::vector<bool> outside_;  // see showsOutside()
    /// An object with such surfaces.
    struct Smooth {
        int id;
        bool mirrors;  // and not only where all reflections are wanted
        Eigen::AlignedBox3f box;
    };
    std::vector<Smooth> smooth_;
};

}  // namespace dollytrack::render
