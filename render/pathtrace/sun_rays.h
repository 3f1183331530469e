#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"
#include "render/pathtrace/traced_surface.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// What shows the outside and has no panes of glass, by id - 1: the sun shines through all of it,
/// as the sky does. Of other windows it shines through the panes.
[[nodiscard]] std::vector<bool> wholeWindows(const Scene& scene);

/// What stands between points and the sun: all within SunLight::shades but windows. Panes of glass
/// elsewhere take their share, cut-outs have holes. Const; keeps references.
class SunRays {
  public:
    SunRays(const Scene& scene, const RayCaster& rays, const TracedSurface& surface,
            const SunLight& sun);

    /// The share of the sun's light that comes along -way to a point just off a surface.
    [[nodiscard]] double share(Eigen::Vector3d from, const Eigen::Vector3d& way) const;

  private:
    const Scene& scene_;
    const RayCaster& rays_;
    const TracedSurface& surface_;
    const SunLight& sun_;
    std::vector<bool> whole_windows_;
};

}  // namespace dollytrack::render
