#pragma once

#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"

namespace dollytrack::semantics {

/// Transfers the objects of a labelled mesh to the textured mesh of the same room. Each triangle
/// gets the label of the same triangle, otherwise of the nearest labelled surface within 2 % of the
/// scene's diagonal; the rest becomes one structure object. The meshes may have different up axes.
/// If the job is cancelled, the result is undefined.
[[nodiscard]] RawScene transferLabels(RawScene labelled, RawScene textured, const JobContext& job);

}  // namespace dollytrack::semantics
