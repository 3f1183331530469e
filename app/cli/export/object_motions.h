#pragma once

#include "engine/camera/trajectory.h"
#include "engine/document/edits.h"
#include "engine/scene/scene.h"
#include "render/scene/object_motion.h"

#include <vector>

namespace dollytrack::cli {

/// The motions of objects with tracks over the frames of a trajectory, whose times are used as
/// track times. The edits must be applied to `scene`.
[[nodiscard]] std::vector<render::ObjectMotion> objectMotions(const Scene& scene,
                                                              const SceneEdits& edits,
                                                              const Trajectory& trajectory);

}  // namespace dollytrack::cli
