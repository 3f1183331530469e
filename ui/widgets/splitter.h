#pragma once

#include <imgui.h>

namespace dollytrack::ui {

/// A draggable line between `low` and `high` (px) that changes a length (px) within `least` ..
/// `most`: that of the part on its left or top (sign +1), or on its right or bottom (sign -1).
/// Returns whether the length changed.
bool splitter(const char* name, ImVec2 low, ImVec2 high, bool vertical, float sign, float& length,
              float least, float most);

}  // namespace dollytrack::ui
