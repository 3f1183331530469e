#pragma once

#include "engine/document/edits.h"
#include "engine/math/pose.h"

#include <string>
#include <string_view>
#include <vector>

// Names of edits in the undo history.

namespace dollytrack {

/// "Move", "Turn" or "Move and turn": how the second pose differs from the first.
std::string_view changeOf(const Pose& before, const Pose& after);
/// The same for a box, or "Resize", "Resize and turn". A resized box is not called moved: dragging
/// one side of it moves its centre as well.
std::string_view changeOf(const OrientedBox& before, const OrientedBox& after);

/// "lamp_3, mug and book": the names of the objects. Of ten or more, the first eight and a count of
/// the rest.
std::string describeObjects(const std::vector<ObjectRef>& objects);

/// "the pinned view of sofa": a pinned point is named like the object that it captures, so this
/// tells it from the object. A point that was placed from a view captures no given object; its own
/// name is returned, such as "view 2".
std::string describeView(const PinnedPoint& point);

}  // namespace dollytrack
