#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Warns of targets that are far larger or smaller than things of their class are (a chair of 4 cm,
/// a picture of 6 m): their class, or what they were put together from, is likely wrong.
void noteSizeDoubts(const Scene& scene, ImportReport& report);

}  // namespace dollytrack
