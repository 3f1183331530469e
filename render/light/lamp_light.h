#pragma once

#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "render/light/irradiance_grid.h"
#include "render/light/light_bounces.h"
#include "render/light/light_rig.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// Direct light at a point from the rig's room lamps, with soft shadows by random sampling. Returns
/// the irradiance vector: the sum of strength * direction to the lamp, in units of lamp intensity.
[[nodiscard]] Eigen::Vector3f roomLampsAt(const Eigen::Vector3d& place, const LightRig& rig,
                                          const RayCaster& rays, Random& random);

/// The same for the rig's scene lamps, by cell. Their light falls off so steeply that cells next to
/// a surface, found with `bounces`, store the light at that surface instead of at their centre.
/// Incomplete if the job is cancelled.
[[nodiscard]] std::vector<Eigen::Vector3f> sceneLampsByCell(const LightRig& rig,
                                                            const RayCaster& rays,
                                                            const IrradianceGrid& cells,
                                                            const LightBounces& bounces,
                                                            const JobContext& job);

}  // namespace dollytrack::render
