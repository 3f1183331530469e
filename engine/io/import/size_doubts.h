#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Warns of targets that are far larger or smaller than things of their class are (a chair of 4 cm,
/// a picture of 6 m): their class, or what they were put together from, is likely wrong.
void noteSizeDoubts(const Scene& scene, ImportReport& report);

/// Warns if the meshes look split by material: nearly every target has a material of its own, and
/// half of the targets lie inside others (the frame, the seat and the screws of each chair are
/// objects).
void noteMaterialSplit(const Scene& scene, ImportReport& report);

}  // namespace dollytrack
