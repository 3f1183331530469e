#pragma once

#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "render/light/light_bounces.h"
#include "render/light/light_cells.h"
#include "render/light/light_rig.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// What falls straight onto a place from the rig's lamps, but its own_lamps, with soft shadows:
/// irradiance vector, the sum of strength * direction, in units of the lamps' intensity.
[[nodiscard]] Eigen::Vector3f placedLampsAt(const Eigen::Vector3d& place, const LightRig& rig,
                                            const RayCaster& rays, Random& random);

/// The same of the rig's own_lamps, by cell. Their light falls off so steeply that cells beside a
/// surface, which the bounces know, get what falls there. Unfinished when cancelled.
[[nodiscard]] std::vector<Eigen::Vector3f> ownLampsByCell(const LightRig& rig,
                                                          const RayCaster& rays,
                                                          const LightCells& cells,
                                                          const LightBounces& bounces,
                                                          const JobContext& job);

}  // namespace dollytrack::render
