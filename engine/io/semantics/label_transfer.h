#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"

namespace dollytrack::semantics {

/// Gives the mesh with the room's colours the objects of the labelled one: each triangle takes the
/// label of the same triangle, else of the nearest labelled surface. The two may have different
/// upward axes. What it returns after a cancelled job is of no use.
[[nodiscard]] RawScene transferLabels(RawScene labelled, RawScene textured, const JobContext& job);

}  // namespace dollytrack::semantics
