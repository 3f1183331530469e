#pragma once

#include "engine/document/edits.h"
#include "engine/math/pose.h"

#include <string>
#include <string_view>
#include <vector>

// How the history names what was done.

namespace dollytrack {

/// "Move", "Turn" or "Move and turn": what was done to a view.
std::string_view changeOf(const Pose& before, const Pose& after);
/// The same of a box, or "Resize". One side drawn out moves the centre as well.
std::string_view changeOf(const OrientedBox& before, const OrientedBox& after);

/// "lamp_3, mug and book": all of them, or the first eight and how many more there are.
std::string listInWords(const std::vector<ObjectRef>& objects);

/// "the pinned view of sofa": a point, which has the name of its object, and not the object. One
/// placed from a view stands for none and is called by its name, "view 2".
std::string viewInWords(const PinnedPoint& point);

}  // namespace dollytrack
