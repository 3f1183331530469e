#pragma once

#include "engine/scene/scene.h"

namespace dollytrack {

/// Warns of targets that are far larger or smaller than is typical for their class (a chair of
/// 4 cm, a picture of 6 m): their class or grouping is probably wrong.
void warnOfUnusualSizes(const Scene& scene, ImportReport& report);

}  // namespace dollytrack
