#pragma once

#include "engine/scene/object.h"

#include <vector>

namespace dollytrack {

/// Sets Object::large. An object is small if its box has less than `small_volume_m3`, or if it
/// stands on or lies inside an object with at least `size_ratio` times its volume. Parts of the
/// building are compared with no other object. Objects whose size the user has set are left
/// unchanged.
void sortBySize(std::vector<Object>& objects, double small_volume_m3, double size_ratio);

}  // namespace dollytrack
