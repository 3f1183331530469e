#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Warns of targets that are far larger or smaller than things of their class are (a chair of 4 cm,
/// a picture of 6 m): their class, or what they were put together from, is likely wrong.
void noteSizeDoubts(const Scene& scene, ImportReport& report);

/// Warns where nearly every target has one material of its own and most lie inside others, as
/// exporters leave things that they split by material: the frame, the seat and the screws of each
/// chair as objects.
void noteMaterialSplit(const Scene& scene, ImportReport& report);

}  // namespace dollytrack
