#pragma once

#include "engine/scene/object.h"

#include <vector>

namespace dollytrack {

/// Marks objects small that have less than `small_volume_m3`, or `size_ratio` times less volume
/// than the object they stand on, hang at or lie in; all others are large. Leaves those alone of
/// which the user said it.
void sortBySize(std::vector<Object>& objects, double small_volume_m3, double size_ratio);

}  // namespace dollytrack
