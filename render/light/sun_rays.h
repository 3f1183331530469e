#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"
#include "render/materials/traced_surface.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// By id - 1: objects that show the outside and have no glass panes, so that the sun shines through
/// all of the object. Other windows are transparent at their panes only.
[[nodiscard]] std::vector<bool> wholeWindows(const Scene& scene);

/// Shadow rays to the sun. Occluders are all surfaces within SunLight::shades except windows; other
/// glass attenuates and cut-outs have holes. Thread-safe. Keeps references.
class SunRays {
  public:
    SunRays(const Scene& scene, const RayCaster& rays, const TracedSurface& surface,
            const SunLight& sun);

    /// Share of sunlight that arrives from the direction `way` at a point just off a surface.
    [[nodiscard]] double share(Eigen::Vector3d from, const Eigen::Vector3d& way) const;

  private:
    const Scene& scene_;
    const RayCaster& rays_;
    const TracedSurface& surface_;
    const SunLight& sun_;
    std::vector<bool> whole_windows_;
};

}  // namespace dollytrack::render
